"""Answers, materials and records as text."""
