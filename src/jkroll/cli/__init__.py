"""The command line: words to a call to an exit code."""
