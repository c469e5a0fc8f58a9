"""What a command asks of a scene, and the answers."""
