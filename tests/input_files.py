"""Small files for command lines: tables and files of materials, valid, broken and unusual."""

import gzip
from pathlib import Path

_GRAINS = b"grain,material,radius [nm],load\na,quartz,100,\nb,gold,50,-2 nN\nc,quarz,100,\nd,quartz,100,-20 nN\n"

CONTENTS = {
    # materials
    "mine.toml": b'[materials.ice]\naliases = ["H2O"]\ndensity = "1 g/cm3"\n',
    "lab.toml": b"""title = "my measurements"

[materials.mine]
aliases = ["M"]
surface_energy = "25\xc2\xb15 mJ/m2"
youngs_modulus = "7 GPa"
poisson_ratio = 0.25
density = "1.0 to 1.2 g/cm3"
notes = { surface_energy = "a note of mine" }
references = ["me-2026"]

[references.me-2026]
type = "misc"
title = "Laboratory notes"
""",
    "shadow.toml": b'[materials.quartz]\nsurface_energy = "50 mJ/m2"\nyoungs_modulus = "70 GPa"\npoisson_ratio = 0.2\n',
    "broken.toml": b"[materials.ice\n",
    "wrong.toml": b'[materials.ice]\nsurface_energy = "25 mJ/m3"\ndensity = -1\n',
    # a force curve
    "curve.csv": (Path(__file__).parent / "data" / "probe.csv").read_bytes(),
    # tables
    "grains.csv": _GRAINS,
    "grains.csv.gz": gzip.compress(_GRAINS, mtime=0),
    "pairs.tsv": (
        b"material\tradius [nm]\tradius2 [m]\tyield_displacement\nquartz\t100\tplane\t\niron\t\t1um\t1 "
        b"angstrom\ngold\t-1\t1 um\t-\n"
    ),
    "pairs.csv": b"""pair,material,material2,radius [um],radius2,gamma [mJ/m2],gamma2 [mJ/m2],young,nu
1,quartz,iron,1,plane,,,,
2,quartz,,1,2um,30,20,,
3,,,0.5,,25,,54GPa,0.17
4,,,0.5,,25,,rigid,
5,iron,quartz,1,1um,,,rigid,0.3
6,silica-dry,ice-warm,1,0.1um,,,,
""",
    "many.csv": b"radius [nm],gamma [mJ/m2],E1 [GPa],poisson,density [g/cm3],load [nN]\n"
    + b"".join(b"%d,%d,%d.5,0.%d,2.6,%d\n" % (5 + n * n, 10 + n, 3 + 2 * n, n % 5, n % 7 - 3) for n in range(60)),
    "states.csv": (
        "material,radius [nm],approach,angle "
        "[deg],ξ,speed\nquartz,100,0.05nm,90,,\nquartz,100,,,1Å,10cm/s\nquartz,100,-1um,,,\n"
    ).encode(),
    "measured.csv": (
        "grain,material,radius [nm],gamma "
        "[mJ/m2]\na,quartz,100±10,25±5\nb,ice-warm,100,\nc,quartz,100,25\nd,,1e2(5),\n"
    ).encode(),
    "ranges.csv": b"material,radius [nm],gamma [mJ/m2]\nquartz,50 to 100,20 to 30\nsilica-dry,100,\nquartz,100,25\n",
    "mixed.csv": "material,radius [nm],gamma [mJ/m2]\nquartz,100±10,20 to 30\nquartz,100,25±5\n".encode(),
    "quoted.csv": (
        b'"name, of grain","material","radius [nm]"\n"a '
        b'""1""","quartz","100"\n"b\nc","iron",1E2\n"=1+1","gold",+1.0e2\n"open,iron,50\n'
    ),
    "spread.csv": b"material,radius [nm],note\n=1+1,100,@x\nquartz,100,-2+3\nquartz,100,'y\n",
    "crlf.csv": b"\xef\xbb\xbfmaterial,radius [nm]\r\nquartz,100\r\n\r\nquartz, 200 \r\nquartz,300",
    "ragged.csv": (
        b"material,radius [nm],load "
        b"[nN]\nquartz,100\nquartz,100,1,2\n,,\nquartz,x,1\nquartz,0,1\nquartz,inf,1\nquartz,1e999,1\n"
    ),
    "named.csv": b"mean grain radius,id\n100nm,1\n",
    "header.csv": b"material,radius [nm]\n",
    "twice.csv": b"radius [nm],radius [um]\n1,2\n",
    "units.csv": b"material,radius [kg],load [nN]\nquartz,1,2\n",
    "results.csv": b"material,radius [nm],pull_off_force [N]\nquartz,100,1\n",
    "wrong.csv": b"radius [nm],radius,radus\n1,2,3\n",
    "odd.csv": (
        b'\xef\xbb\xbfradius;gamma [mJ/m2];note\r\n1e400nm;25;\xff\n\n100 '
        b'nm;0;=1+1;more\r\n1um\n"1\n2um";7;\xc3\xa9'
    ),
    "forces.csv": b"probe,R1 (um),P_c (nN),P_c_err (nN)\na,2,300,20\nb,1,-5,\nc,,250,\nd,2,,\n",
    "bars.csv": b"label,gamma [mJ/m2],gamma_err (%),R_min [nm],R_max [nm],E_std\na,25,20,90,110,1\nb,25,,,,\n",
    "labels.csv": (
        b"Material,E_GPa,nu,R1 (um),gamma [mJ/m2]\nAISI "
        b"1020,200,0.29,1,50\nquartz,,,1,\nSiO2,70,0.17,1,25\nPTFE,,0.4,1,20\n"
    ),
    "german.csv": "Name;R1 (µm);gamma [mJ/m2];E [GPa];nu\nA, b;1,5;25,0;54;0,17\nB;2;3e1;70,5;,2\n".encode(),
    "columns.dat": b"#  radius_um   gamma_mJ_m2 \n  1.5  25\n\n2\t30  \n",
    "empty.csv": b"",
    "grains.ndjson": (
        b'{"material": "quartz", "radius [m]": 1e-7}\n{"material": null, "radius [m]": "1 um"}\n[]\n{"radius [m]": '
        b'NaN\n'
    ),
    "good.ndjson": (
        b'{"id": 1, "material": "quartz", "radius [nm]": 100, "load": null}\n{"id": "b", "material": "gold", "radius '
        b'[nm]": "2 um", "load": "-2 nN", "more": [1, {"x": 2}]}\n'
    ),
}  # fmt: skip
