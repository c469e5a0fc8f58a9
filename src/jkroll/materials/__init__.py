"""Materials: whose data, and where they come from."""
