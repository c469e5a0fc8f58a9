"""The questions that commands ask of a frame, and the reports that answer them."""
