"""Scenes that are asked together: the rows of a list or a table, and the results, doubts and reasons of each."""
