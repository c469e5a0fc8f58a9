"""The questions that commands ask of a scene, and the answers."""
