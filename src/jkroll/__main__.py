"""`python -m jkroll` is `jkroll`."""

from .cli import run

if __name__ == "__main__":
    run()
