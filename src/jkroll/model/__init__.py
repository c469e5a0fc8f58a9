"""The model: quantities computed from inputs, with their limits and best ranges."""
