"""Tables of random rows."""


def random_table(size: int, seed: int) -> str:
    """Grains of every kind that a table can mix."""
    import random

    draw = random.Random(seed)
    lines = [
        "material,radius [nm],material2,radius2 [um],load [nN],yield_displacement,surface_energy [mJ/m2],speed [m/s]"
    ]
    for _ in range(size):
        cells = [
            draw.choice(["quartz", "iron", "gold", "PS", ""]),
            draw.choice(
                [f"{10 ** draw.uniform(-1, 5):.{draw.randint(1, 17)}g}", "100", "1e2", f"{draw.uniform(1, 9):.3f} um"]
            ),
            draw.choice(["", "", "quartz", "graphite"]),
            draw.choice(["", "plane", repr(10 ** draw.uniform(-3, 2))]),
            draw.choice(["", "0", repr(draw.uniform(-5, 20)), "-1e6"]),
            draw.choice(["2 angstrom", "0.1 nm"]),
            draw.choice(["", repr(10 ** draw.uniform(0, 3))]),
            draw.choice(["", repr(draw.uniform(0.1, 9))]),
        ]
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


# Small blocks, and processes for all but the first of them: a kill finds every state of a short run.
IN_SMALL_BLOCKS = """
import signal
import jkroll.__main__
from jkroll.batch import files, run
from jkroll.rows import columns
run.ALONE, files.CHUNK, columns.BLOCK = 2, 1 << 14, 1 << 9
if __name__ == "__main__":
    signal.signal(signal.SIGHUP, signal.SIG_DFL)  # a closed terminal ends the run, under nohup, too
    jkroll.__main__.run()
"""
