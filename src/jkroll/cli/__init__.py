"""The command line: from words to a call to an exit code."""
