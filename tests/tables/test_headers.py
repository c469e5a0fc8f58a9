"""Headers as people write them: each is read correctly, refused with a remedy, or passed through and named."""

import csv
import re
import shlex
from itertools import product
from math import pi
from pathlib import Path
from typing import Any
from unittest.mock import patch

import orjson
import pytest

from harness import Run
from jkroll import Interval, Measured
from jkroll.errors import BadRequest, BadTable
from jkroll.tables.files import format_of_name, input_format, output_format
from jkroll.tables.header import stated_meanings, understood
from jkroll.tables.reading import reading_of
from random_tables import read_rows, write_rows
from relative import approx

# Headers, grouped by input and unit (in SI units). Their cells are bare numbers. R is R1 only if R2 is known.
_READ = r"""
radius 1e-9: radius [nm] | Radius [nm] | R1 (nm) | R_1 [nm] | radius1 [nm] | R1_nm | radius in nm | radius, nm
radius 1e-9: r1 [nm] | radius/nm | radius / (nm) | R (nm) | R_nm | rad_nm | radii [nm]
radius 1e-6: RADIUS (um) | R1 (um) | radius_um | R1 / µm | R / µm | RADIUS [UM]
radius2 1e-9: R2_nm_ | R2 (nm) | radius_2 [nm] | R₂ [nm] | radius₂ [nm]
radius2 1e-6: R_2/um | r2_um | r2..um. | R2 - µm | R2_um_ | $R_{2}$ [$\mu$m] | R_2 (\mu m)
work_of_adhesion 1e-3: W [mJ/m2] | Δγ (mJ/m2) | w [mJ/m2] | Work of adhesion (mJ/m2)
work_of_adhesion 1: W_adh (J m-2)
surface_energy 1e-3: SFE [mJ/m2] | γ [mJ/m2] | γ1 (mJ/m²) | gamma1 [mJ/m2] | Gamma [mJ/m2] | gamma_mJ_m2
surface_energy 1e-3: surface_energy_mJ_m2 | surface_energy_mJ_per_m2 | γ / (mJ/m²) | γ (mJ.m-2) | gamma, mJ.m-2
surface_energy 1e-3: gamma..mJ.m2. | gamma_mJ_m2_
yield_displacement 1e-10: critical rolling displacement (Å) | ξ (Å)
surface_energy 1: surface energy (J/m^2)
surface_energy2 1e-3: γ2 [mJ/m2] | γ₂ (mJ/m²)
surface_energy2 1: gamma_2 [J/m2]
youngs_modulus 1e9: E [GPa] | E_GPa | E1_GPa | E_1 [GPa] | Young's modulus (GPa) | youngs modulus, GPa
youngs_modulus 1e9: Young modulus in GPa | young_GPa | E₁ (GPa) | elastic_modulus_gpa | young GPa | E_GPA
youngs_modulus 1e9: E [Gpa] | youngsModulus (GPa) | Emod [GPa] | elastic moduli (GPa)
youngs_modulus 1e9: e_gpa | e (GPa) | E - GPa | E1_GPa_
youngs_modulus 1e6: E (MPa) | Young's Modulus [MPa]
youngs_modulus2 1: E2 [Pa]
energy 1: E [J]
energy 1.602176634e-19: E (eV)
poisson_ratio 1: nu | ν | Nu1 | Poisson's ratio | Poisson ratio | poisson_ratio (-)
poisson_ratio2 1: ν2
surface_energy 1e-3: γ (mN.m-1) | $\gamma_1$ [mJ m$^{-2}$]
speed 1: velocity [m.s-1] | Speed (m·s⁻¹) | velocity_mps | v [m/s] | Speed (m/s) | velocity (m/s) | v_imp (m/s)
speed 1e-2: v_cm_s | V_CM_S
density 1: rho [kg/m3] | ρ (kg/m³) | density_kg_m3 | Density (kg/m^3) | rho_kgm3
density 1e3: RHO [g/cm3] | Rho (g/cm3) | density_g_cm3 | density_gcm3
yield_displacement 1e-9: xi [nm]
load 1e-9: P (nN) | P_nN | Load/nN | load <nN> | load ⟨nN⟩
load 1e-6: load (µN)
load 1e-12: load_pN | loadPN | load P (pN)
hamaker 1e-18: hamaker_aJ | Hamaker constant A (aJ)
hamaker 1e-21: A (zJ) | hamaker_zJ | Hamaker constant (zJ)
gravity 1: g [m/s2]
gravity 9.80665: gravity [g] | g [g]
atomic_spacing 1e-9: z0 (nm)
approach_at_load 1e-9: δ [nm]
contact_modulus 1e9: E* [GPa] | E_r (GPa) | reduced modulus (GPa) | Effective Young's modulus [GPa]
contact_modulus 1e9: Reduced Young Modulus [GPa] | Reduced Young's modulus (GPa) | E_red [GPa] | E_red_GPa
reduced_radius 1e-9: reduced_radius [nm]
radius 1e-9: radius【nm】 | radius–nm | radius = nm | radius R (nm)
youngs_modulus 1e9: E-Modul [GPa] | E · GPa | E1 – GPa | Elastic Modulus E (GPa) | Young's modulus E1 [GPa]
density 1: Density ρ (kg/m³) | densities [kg/m3]
diameter 1e-6: diameter [um] | Dia (µm) | diam_um | Durchmesser [um] | Diameter, um | diameters (um) | Diameter D (um)
diameter2 1e-6: diameter2 [um] | Diameter 2, um
shear_modulus 1e9: shear modulus (GPa) | G [GPa] | G1_GPa | Shear Modulus G [GPa] | Schubmodul (GPa)
shear_modulus2 1e6: shear_modulus2 [MPa] | G2 (MPa)
hamaker 1e-21: Hamaker constant A (zJ) | a_zj
radius 1e-6: Rayon (µm) | rayon de la sphère [µm] | Kugelradius [um]
radius 1e-9: rayon [nm] | Spitzenradius [nm] | Teilchenradius (nm) | radio [nm] | raggio [nm] | Radius Spitze [nm]
diameter 1e-6: Diamètre (µm) | diámetro (um) | Partikeldurchmesser [µm]
surface_energy 1e-3: Énergie de surface (mJ/m²) | Oberflächenenergie [mJ/m2] | energia superficiale (mJ/m²)
youngs_modulus 1e9: Elastizitätsmodul [GPa] | Module d'Young (GPa) | module d'Young de la pointe (GPa)
youngs_modulus2 1e9: E-Modul Substrat [GPa] | E Wand (GPa)
density 1e3: Dichte [g/cm3] | Masse volumique (g/cm³)
poisson_ratio 1: Querkontraktionszahl | Coefficient de Poisson
load 1e-9: Charge (nN) | Last [nN] | Last_nN | carga (nN)
"""


def meanings(line: str) -> dict[str, tuple[str, float]]:
    """Return, for each header of a line, the input and its unit in SI units."""
    meaning, _, texts = line.partition(": ")
    name, unit = meaning.split()
    return {text: (name, float(unit)) for text in texts.split(" | ")}


READ: dict[str, tuple[str, float]] = {}
for _line in _READ.strip().splitlines():
    READ |= meanings(_line)
READ |= dict.fromkeys((' "gamma [mJ/m2]"', "\u200fsurface energy [mJ∙m⁻²]\u200e"), ("surface_energy", 1e-3))
_LACKING = "(first cell '100'): no unit in the header or in the first cell. Write --column"
_FACTOR = "the name of the quantity or its unit has a sign or a factor"
# The unit is unclear if a program wrote _m for µm or changed the case of letters: MN may be mN, and Zj zJ.
LOSSY = ("radius__m_", "Load___N_", "hamakerZj", "load_MN", "speed__m_s_")
REFUSED = {
    **{
        text: f"it may be a diameter. Write --column '{text}=diameter [{unit}]', or --column"
        for text, unit in {
            "d": "UNIT",
            "D [nm]": "nm",
            "d_p [um]": "um",
            "Dp (nm)": "nm",
            "d_um": "um",
            "Ø [nm]": "nm",
        }.items()
    },
    "D2 [um]": "Write --column 'D2 [um]=diameter2 [um]', or",
    **{
        text: f"a radius or a diameter. Write --column '{text}=radius{unit}' or --column '{text}=diameter{unit}', or"
        for text, unit in {"size": " [UNIT]", "particle size [um]": " [um]", "size2_um": "2 [um]"}.items()
    },
    "Diameter": f"Diameter' {_LACKING} 'Diameter=diameter [UNIT]', or --column 'Diameter=' to pass it through",
    "equivalent diameter [um]": "Write a column diameter [UNIT] instead of 'equivalent diameter [um]', or",
    "G_s [GPa]": "=shear_modulus [GPa]' or --column 'G_s [GPa]=shear_modulus2 [GPa]'",
    "r [nm]": "r may be a radius or a distance. Write --column 'r [nm]=radius [nm]'",
    **dict.fromkeys(("s [nm]", "S (nm)"), "s may be an asperity radius or a distance. Write --column"),
    **dict.fromkeys(("indentation [nm]", "Overlap (nm)"), "it may be the approach. Write --column"),
    "R* [nm]": "'R* [nm]=reduced_radius [nm]'",
    "W_12 (mJ/m²)": "'W_12 (mJ/m²)=work_of_adhesion [mJ/m²]'",
    "γ12 (mJ/m²)": "a column work_of_adhesion [UNIT] instead of",
    "adhesion [mJ/m2]": "it may be the work of adhesion of the pair",
    "R [nm]": "--column 'R [nm]=radius [nm]' or --column 'R [nm]=reduced_radius [nm]'",
    "R_um": "=reduced_radius [um]'",
    **{
        word: f"{word}' {_LACKING} '{word}={name} [UNIT]', or --column '{word}=' to pass it through"
        for word, name in {"radius": "radius", "density": "density", "Radius": "radius"}.items()
    },
    "radius ()": "no unit in the header or in the first cell",
    "radius [kg]": "the text after 'radius' is not its unit",
    "Energy (old)": "the text after 'Energy' is not its unit",
    "radiuss [nm]": "=radius [nm]'",
    **dict.fromkeys(("radius [?m]", "LOAD [PN]", "Radius (Mm)", "load [-nN]", *LOSSY), "is not its unit. Write"),
    "asperity tip radius [nm]": "Write a column asperity_radius [UNIT] instead of",
    "rho_w [kg/m3]": "Write a column density [UNIT] or density2 [UNIT] instead of",
    "loadpN": "'loadpN=load [UNIT]'",  # not read as newtons
    # The text before N or J may be a prefix of the unit or a part of the name.
    **dict.fromkeys(("load_p_n", "Load.P..N.", "load_micro_N"), "=load [UNIT]'"),
    **dict.fromkeys(("Hamaker.A.J.", "hamaker_a_j"), "=hamaker [UNIT]'"),
    # The next two may hold another quantity or a spread.
    "maxLoad___N_": "Write a column load [UNIT] instead of 'maxLoad___N_', or",
    "load_uncertanty [nN]": "Write a column load [UNIT] instead of 'load_uncertanty [nN]', or",
    "mean\u2009load\n[nN]": "'mean load [nN]=load [nN]'",
    "Young's E (mean $x$) [GPa]": '"Young\'s E (mean \\$x\\$) [GPa]="',
    "E (Young's modulus) [GPa]": "it may be youngs_modulus",
    "gamma' [mJ/m2]": "it may be surface_energy",
    "surface energy (polar) [mJ/m2]": "a column surface_energy [UNIT] or surface_energy2 [UNIT] instead of",
    "gama [mJ/m2]": "=surface_energy [mJ/m2]'",
    "gama": "=surface_energy [UNIT]'",
    "surface_energy in GPa": "the text after 'surface_energy' is not its unit",
    "log radius [nm]": "Write a column radius [UNIT] instead of 'log radius [nm]', or --column",
    "radius_cv [nm]": "Write a column radius [UNIT] or radius2 [UNIT] instead of 'radius_cv [nm]', or --column",
    **{
        f"{word} [nm]": f"'{word} [nm]=radius [nm]' or --column '{word} [nm]=reduced_radius [nm]', or"
        for word in ("Equivalent radius", "harmonic mean radius", "combined radius")
    },
    "Reduced Young Modulus": "'Reduced Young Modulus=contact_modulus [UNIT]', or",
    "gravity (g)": "the text after 'gravity' is not its unit",  # g may be the symbol for gravity
    "DMT modulus (MPa)": "it may be Young's modulus, or E* of the contact",
    **dict.fromkeys(("radius*1e9", "E [1e9 Pa]", "A (10^-20 J)", "density¹ [kg/m³]"), _FACTOR),
    "radius (×10⁻⁶ m)": f"{_FACTOR}. Write --column 'radius (×10⁻⁶ m)=radius [um]', or",
    "radius (10^-9 m)": f"{_FACTOR}. Write --column 'radius (10^-9 m)=radius [nm]', or",
    "2gamma [mJ/m2]": "w = 2γ. Write --column '2gamma [mJ/m2]=work_of_adhesion [mJ/m2]', or",
    "2γ": "w = 2γ. Write --column '2γ=work_of_adhesion [UNIT]', or",
    **{
        text: f"'{text}=surface_energy [J/m^2]' or --column '{text}=surface_energy2 [J/m^2]', or"
        for text in ("Surface Energy JKR (J/m^2)", "surface energy per area [J/m^2]")
    },
    "work_of_adhesion_mJ": "the text after 'work_of_adhesion' is not its unit",
    **dict.fromkeys(("modulus (GPa)", "modulus1 [GPa]"), "it may be Young's modulus"),
    "normal force [nN]": "it may be a load, or a force that was measured",
    "F_n [nN]": "--column 'F_n [nN]=load [nN]'",
    "hysteresis (mJ/m2)": "it may be another hysteresis",
    "gamma [nm]": "the text after 'gamma' is not its unit",  # nm is not read as N/m
    "R_p [nm]": "--column 'R_p [nm]=radius [nm]'",
    "E_avg (GPa)": "=youngs_modulus [GPa]' or --column 'E_avg (GPa)=youngs_modulus2 [GPa]'",
    **dict.fromkeys(("rho_p [kg/m3]", "ρs (g/cm³)"), "it may be density"),
    "second radius (nm)": "Write --column 'second radius (nm)=radius2 [nm]', or",
    **dict.fromkeys(("applied tip load [nN]", "laod [nN]", "Indentation load (nN)"), "=load [nN]'"),
    "radius_max [nm]": "does not complete an uncertainty of radius",
    **dict.fromkeys(("-load [nN]", "radius/2 [nm]", "w=2γ [mJ/m2]", "radius (nm) x 10"), _FACTOR),
    **dict.fromkeys(
        ("radius [nm] * 1e3", "radius (nm) ×10⁻³", "load [nN]/2", "γ+", "γ-", "load-", "E- [GPa]"), _FACTOR
    ),
    **dict.fromkeys(("γ- [mJ/m2]", "γ⁺ (mJ/m²)", "γ⁻ (mJ/m²)", "gamma- [mJ/m2]", "$\\gamma^{-}$ [mJ/m2]"), _FACTOR),
}
PASSING = (
    "E | E- | v | rho | g | N | phi | R [kOhm] | E_bar | R_m | v_c | w | load_case | "
    "material_3 | velocity_x (m/s) | bulk modulus (GPa) | 1/radius [1/nm] | T [K] | "
    "gamma_err [mJ/m2] | F (nN) | P [MPa] | pull_off_force [N] | material_name | "
    "material_id | density_type | d [s] | equivalent diameter [um] | v_m | hysteresis_ratio | spread [m/s] | "
    "sigma_xx [Pa] | u [m/s] | u(x) [nm] | sigma [Pa] | kinetic_energy [J] | head [nN] | grain area [nm^2] | "
    "nu_g0 | E...MPa. | velocity_c_m_s | E_loss (GPa) | rho_bulk [kg/m3] | num [-] | nu_e [Hz] | "
    "speed of sound (m/s) | tilt angle (deg) | energy_per_atom_eV | R | n_c | Size (mm) | rad | rad [1/s] | "
    "G' (GPa) | storage shear modulus (Pa) | charge | charge [pC] | Last | last_id | charge_C"
).split(" | ")


def test_each_spelling_of_a_header_is_read() -> None:
    for text, (name, unit) in READ.items():
        (column,) = understood([text], [["0.5"]], given=["radius2"] if text.startswith("R") else []).inputs
        assert (column.name, column.value("0.5")) == (name, approx(0.5 * unit, rel=1e-15)), text


def test_a_header_in_wrongly_decoded_utf_8_is_read() -> None:
    mistaken = {text.encode().decode("latin-1"): text for text in READ if not text.isascii()}
    mistaken |= {"Î³ (mJ/mÂ²)": "γ1 (mJ/m²)", "Râ‚‚ (nm)": "R₂ [nm]", "Î¾ (Ã…)": "ξ (Å)", "Poissonâ€™s ratio": "ν"}
    for text, meant in mistaken.items():
        assert reading_of(text)[:2] == reading_of(meant)[:2], text
    assert reading_of("surface energy (eV/Å²)").unit_text == "eV/Å²"


@pytest.mark.parametrize("text", REFUSED)
def test_a_wrong_or_ambiguous_header_is_refused_with_a_remedy(run: Run, text: str) -> None:
    Path("x.csv").write_text(f'name,"{text}"\na,100\n', encoding="utf-8")
    ran = run("batch", "x.csv", "--material", "quartz", "-o", "out.csv")
    assert (ran.code, REFUSED[text] in ran.err) == (2, True), ran.err
    for advice in re.findall(r"--column (?:'[^']*'|\"[^\"]*\")", ran.err):
        typed = shlex.split(advice.replace("UNIT", "m").replace("\\$", "$"))  # shlex keeps the \ before $
        assert "the table has no column" not in run("batch", "x.csv", "--material", "quartz", *typed).err
    if REFUSED[text] == _FACTOR:
        assert ran.err.count("--column") == 1  # only the advice to pass the column through is certain


@pytest.mark.parametrize("text", PASSING)
def test_a_header_that_passes_through_is_named(run: Run, text: str) -> None:
    others = ",".join(f"x{number}" for number in range(20))
    Path("x.csv").write_text(f"{others},{text},radius [um]\n{','.join('1' * 22)}\n", encoding="utf-8")
    ran = run("batch", "x.csv", "--material", "quartz", "--quantities", "pull_off_force_dmt", "-o", "out.csv")
    said = ran.err.splitlines()[0].replace('"', "")
    assert said.startswith("read: radius [um]; passed through: x0, ")
    assert f", x19, {text}" in said or f" and {text}" in said


def test_a_quiet_call_names_no_column(run: Run) -> None:
    Path("x.csv").write_text("id,radius [um]\n1,1\n", encoding="utf-8")
    assert run("batch x.csv --material quartz --quantities pull_off_force_dmt -o out.csv --quiet").err == ""


def test_a_symbol_without_a_unit_is_an_input_if_its_cells_have_units() -> None:
    assert understood(["R", "v"], [["", "2 nm"], ["100 nm", "1"]], given=["radius2"]).names == {"radius"}
    assert understood(["R2"], [["flat"], ["1 um"]]).names == {"radius2"}
    assert not understood(["R"], [["2.5 kOhm"]]).names


def test_a_prime_is_part_of_a_symbol_and_quotes_are_not() -> None:
    """E' is the plane-strain or the storage modulus, and E'' the loss modulus."""
    for text in ("E'", "E''", "E′"):
        assert not understood([text], [["3 GPa"]]).names
    for text in ("'E'", '"E"', "'E [GPa]'"):
        assert understood([text], [["3 GPa"]]).names == {"youngs_modulus"}


@pytest.mark.parametrize("other", ["D2 [um]", "radius [nm].1", "E_sample [GPa]", "surface gamma (J/m2)", "γ12 [mJ/m2]"])
def test_a_column_that_may_be_of_sphere_2_or_the_pair_is_refused(other: str) -> None:
    """If the column passed through, values of sphere 1 would replace its values."""
    with pytest.raises(BadTable, match=re.escape(f"'{other}': ")):
        understood(["radius_um", "E [GPa]", "gamma_mJ_m2", other])


@pytest.mark.parametrize("other", ["G12 [GPa]", "nu12", "ν_xy", "E3 [GPa]", "E_3_GPa"])
def test_moduli_along_directions_are_not_read_as_moduli_of_two_spheres(other: str) -> None:
    with pytest.raises(BadTable, match="may be a modulus along one direction"):
        understood(["E1 [GPa]", "E2 [GPa]", other])
    stated = stated_meanings(["E1 [GPa]=youngs_modulus", "E2 [GPa]="])
    assert understood(["E1 [GPa]", "E2 [GPa]", other], [], stated).names == {"youngs_modulus"}


@pytest.mark.parametrize("parts", [("radius", "radius_err"), ("radius", "radius_minus", "radius_plus")])
def test_a_unit_given_by_option_column_applies_to_a_value_and_its_uncertainty(parts: tuple[str, ...]) -> None:
    with pytest.raises(BadTable, match=r"Write --column 'radius=radius \[UNIT\]', or --column 'radius='"):
        understood(parts, [["100", "5", "6"][: len(parts)]])
    (column,) = understood(parts, [["100", "5", "6"][: len(parts)]], stated_meanings(["radius=radius [nm]"])).inputs
    assert len(column.sides) == len(parts) - 1


@pytest.mark.parametrize("nothing", ["", "NaN", "NA", "n/a", "--"])
@pytest.mark.parametrize("text", ["gama [mJ/m2]", "gamma", "D [nm]"])
def test_a_column_is_refused_even_if_its_first_cell_has_no_value(text: str, nothing: str) -> None:
    """The next cell decides. If the column passed through, another number would replace its values."""
    with pytest.raises(BadTable, match=r"first cell '25'"):
        understood([text], [[nothing], ["25"]])


MISTAKEN = "radius [nm],Surface energy mJ,Young modulus GP\n100,25,54\n"
UNITS_TO_WRITE = "--column 'Radius=radius [nm]' --column 'Surface energy=surface_energy [mJ/m2]'\n"


@pytest.mark.parametrize(
    ("text", "words", "said"),
    [
        # A spreadsheet writes the line sep=;.
        ("sep=;\nradius [nm];load [nN]\n100;1\n", "x.csv", "write --delimiter semicolon"),
        ("PK", "x.xlsx", "'x.xlsx': its name has no known extension; save it as CSV"),
        ('name radius_nm\n"a b 1\n', "x.txt --delimiter blank", """line 2: a quote is not closed in '"a b 1'"""),
        # All mistakes are reported together.
        (MISTAKEN, "x.csv", "--column 'Surface energy mJ=surface_energy [UNIT]'"),
        (MISTAKEN, "x.csv", "--column 'Young modulus GP=youngs_modulus [UNIT]'"),
        ("Radius,Surface energy,n\nnm,mJ/m2,1\n100,25,2\n", "x.csv", f"Delete that row, and write {UNITS_TO_WRITE}"),
        ("material,radius_nm,law\nquartz,100,Maugis\n", "x.csv",
         "the law is an option: --model maugis. Write --column 'law=' to pass it through"),
    ],
)  # fmt: skip
def test_the_refusal_of_a_table_names_the_remedy(run: Run, text: str, words: str, said: str) -> None:
    Path(words.split(maxsplit=1)[0]).write_text(text, encoding="utf-8")
    ran = run(f"batch {words} --material quartz")
    assert (ran.code, said in ran.err) == (2, True), ran.err


@pytest.mark.parametrize(("name", "mark"), [("semicolon", ";"), ("comma", ",")])
def test_a_line_with_the_separator_for_a_spreadsheet_is_skipped(run: Run, name: str, mark: str) -> None:
    Path("x.csv").write_text("sep=;\nradius [nm];load [nN]\n100;1\n".replace(";", mark), encoding="utf-8")
    ran = run(f"batch x.csv --delimiter {name} --material quartz --quantities pull_off_force --no-doubt -o out.csv")
    assert (ran.code, "lines skipped before the header: 1" in ran.err) == (0, True)
    header, row = Path("out.csv").read_text(encoding="utf-8").splitlines()
    assert (header.split(mark)[:2], row.split(mark)[:2]) == (["radius [nm]", "load [nN]"], ["100", "1"])


# --- Meanings given by option --column --------------------------------------------------------------------------------


@pytest.mark.parametrize("end", ["csv", "ndjson", "parquet"])
def test_a_chosen_meaning_outranks_the_header(run: Run, end: str) -> None:
    row = {"tip (µm)": 2.0, "R1 (nm)": 100.0, "E": 70.0, "radius [nm]": 3.0}
    chosen = ("tip (µm)=radius2 [um]", "R1 (nm)=radius [nm]", "radius [nm]=", "E=young [GPa]")
    columns = [f"--column={choice}" for choice in chosen]
    options = ["--material", "quartz", "--quantities", "contact_radius", "-o", f"out.{end}"]
    ran = run("batch", write_rows([row], f"x.{end}"), *columns, *options)
    assert ran.err.splitlines()[0] == (
        'read: radius2 [um] from "tip (µm)", radius [nm] from "R1 (nm)", youngs_modulus [GPa] from E; '
        "passed through: radius [nm]"
    )
    wanted = run("contact quartz 100nm --radius2 2um --young 70GPa --quantities contact_radius --bare --quiet").out
    (written,) = read_rows(f"out.{end}")
    assert (ran.code, float(written["contact_radius [m]"])) == (0, approx(float(wanted), rel=1e-12))


def test_option_column_applies_to_many_files_and_to_a_resumed_run(run: Run) -> None:
    Path("in").mkdir()
    for name in "ab":
        Path(f"in/{name}.csv").write_text("size,material\n100,quartz\n", encoding="utf-8")
    words = ["batch", "in/*.csv", "-o", "out/", "--column", "size=radius [nm]", "--quantities", "pull_off_force"]
    assert run(*words).code == 0
    assert run(*words, "--resume") == (0, "", "note: 2 of 2 output files are up to date and were kept\n")


@pytest.mark.parametrize(
    ("column", "problem"),
    [
        ("R", "is not of the form"),
        ("", "is not of the form"),
        ("R=nonsense", "is not an input"),
        ("R=R", "is not an input"),
        ("R=radiuss [nm]", "it may be radius; write one, as in radius [nm]"),
    ],
)
def test_a_bad_value_of_option_column_is_refused(column: str, problem: str) -> None:
    with pytest.raises(BadRequest, match=problem.replace("[", r"\[")):
        stated_meanings([column])


def test_option_column_needs_a_column_of_the_table_and_a_unit_of_the_input() -> None:
    with pytest.raises(BadTable, match="no column 'radius'; it has Radius"):
        understood(["Radius"], [], stated_meanings(["radius=radius [nm]"]))
    with pytest.raises(BadRequest, match="is not its unit"):
        understood(["size"], [], stated_meanings(["size=radius [kg]"]))
    with pytest.raises(BadTable, match="Write --column 'A 1e-20 J=hamaker "):  # the unit is not guessed
        understood(["A 1e-20 J"], [["6.5"]], stated_meanings(["A 1e-20 J=hamaker"]))
    with pytest.raises(BadRequest, match="more than once"):
        stated_meanings(["size=radius [nm]", "size="])


def test_a_row_with_a_new_symbol_fails_only_if_its_value_has_a_unit(run: Run) -> None:
    lines = ['{"radius [nm]": 100}', '{"radius [nm]": 100, "E": 3}', '{"radius [nm]": 100, "E": "3 GPa"}']
    Path("x.ndjson").write_text("\n".join(lines), encoding="utf-8")
    run("batch x.ndjson --material quartz --quantities pull_off_force -o out.ndjson")
    status = [orjson.loads(line)["status"] for line in Path("out.ndjson").read_text(encoding="utf-8").splitlines()]
    assert status == [None, None, "has 'E', which the first line does not have"]


def test_common_headers_are_read_without_pint() -> None:
    """The search for a separator needs no Pint either. Loading Pint takes as long as converting many rows."""
    with patch("jkroll.quantities.units._registry", side_effect=AssertionError):
        reading_of.cache_clear()
        understood(["id", "radius [m]", "surface_energy [J/m^2]", "sample_id", "poisson_ratio"])
        assert not reading_of("[Pa],poisson_ratio,density").name


# --- Uncertainties ----------------------------------------------------------------------------------------------------

# Columns of a value and its uncertainty, each with the equivalent cell.
PARTS = {
    ("gamma [mJ/m2]=25", "gamma_err [mJ/m2]=5"): "25±5 mJ/m2",
    ("gamma_mJ_m2=25", "gamma_mJ_m2_std=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "u(gamma) [mJ/m2]=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "σ_γ (mJ/m²)=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "σ(γ) (%)=20"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "Uncertainty of surface energy (J/m2)=0.005"): "25±5 mJ/m2",
    ("surface energy (mJ/m2)=25", "surface energy error (mJ/m2)=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "± gamma [J/m2]=0.005"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma ± (%)=20"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "Gamma (mJ/m2) ±=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "±=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "SD=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "Std. dev. (J/m2)=0.005"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "error (%)=20"): "25±5 mJ/m2",
    ("gamma (mJ/m2)=25", "+/-=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_err_percent=20"): "25±5 mJ/m2",
    ("gamma=25 mJ/m2", "gamma_err=5 mJ/m2"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_stderr [mJ/m2]=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "Std. Error=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "standard uncertainty of gamma [mJ/m2]=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "RSD [%]=20"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_cv [%]=20"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "relative error of gamma (%)=20"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "U(γ) [mJ/m2] (k=2)=10"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_err (k = 2.0)=10"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "expanded uncertainty (k=2) [J/m2]=0.01"): "25±5 mJ/m2",
    ("gamma=25 mJ/m2", "± (k=2)=10 mJ/m2"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_minus (k=2)=-8", "gamma_plus (k=2)=12"): "25 +6/-4 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_minus [mJ/m2]=4", "gamma_plus [mJ/m2]=6"): "25 +6/-4 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_minus=-4", "gamma_plus=+6"): "25 +6/-4 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_minus=0", "gamma_plus=6"): "25 +6/-0 mJ/m2",
    ("gamma_min [mJ/m2]=20", "gamma_max [mJ/m2]=30"): "20 to 30 mJ/m2",
    ("gamma_lower (mJ/m2)=20", "gamma_upper (mJ/m2)=30"): "20 to 30 mJ/m2",
    ("gamma_mJ_m2_low=20", "gamma_mJ_m2_high=30"): "20 to 30 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_err [mJ/m2]="): "25 mJ/m2",
    ("gamma [mJ/m2]=25", "Fehler [mJ/m2]=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "Erreur (mJ/m²)=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "incertitude=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "Unsicherheit=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "Standardabweichung [J/m2]=0.005"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "écart-type [mJ/m2]=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "Fehler von gamma [mJ/m2]=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "gamma_Fehler=5"): "25±5 mJ/m2",
    ("gamma [mJ/m2]=25", "erweiterte Unsicherheit (k=2)=10"): "25±5 mJ/m2",
}


def test_a_column_of_plus_or_minus_belongs_to_the_input_on_its_left() -> None:
    header = understood(["label", "±", "R1 [nm]", "note", "gamma [mJ/m2]", "+/-"])
    assert header.positions == {"radius": 2, "surface_energy": 4, "surface_energy_both": 5}
    coded = understood(["gamma [mJ/m2]", "error"], [["25", "E07"]])
    assert not coded.inputs[0].sides


@pytest.mark.parametrize("empty", ["", "Unnamed: 2"])
def test_an_empty_header_may_have_a_name_of_pandas(empty: str) -> None:
    """`pandas.read_csv` names an empty header by its position."""
    names = ["radius [nm]", empty, "gamma [mJ/m2]"]
    assert understood(names, [["100", "±5", "25"]]).positions == {"radius": 0, "radius_both": 1, "surface_energy": 2}
    assert understood(["radius [nm]", empty, "sd [nm]"]).positions == {"radius": 0, "radius_both": 2}
    assert reading_of(empty) == reading_of("")
    named = understood(names, [["100", "ice", "25"]], stated_meanings([f"{empty}=material"]))
    assert named.names == {"radius", "material", "surface_energy"}


def test_the_name_of_the_measured_quantity_matches_no_other_column() -> None:
    header = understood(["R1 [um]", "F [old]", "x (y)"], [], {"F [old]": "pull_off_force [nN]"}, (), "pull_off_force")
    assert {column.name: column.position for column in header.inputs} == {"radius": 0, "pull_off_force": 1}
    no_word = "sticking_speed_paszun_dominik"  # its symbol, v_stick(1.07), is not a word
    assert understood(["R1 [um]", "x (y)"], [], {}, (), no_word).names == {"radius"}


@pytest.mark.parametrize(
    ("columns", "ending"),
    [
        *product(PARTS, ["csv"]),
        *product([*PARTS][::7], ["ndjson", "parquet"]),
    ],
)
def test_columns_of_a_value_and_its_uncertainty_equal_a_cell_with_both(
    run: Run, columns: tuple[str, ...], ending: str
) -> None:
    texts = dict(column.rsplit("=", 1) for column in columns)
    results = []
    for cells in (texts, {"gamma": PARTS[columns]}):
        rows = [{**cells, "R1 (nm)": "100"}, {**dict.fromkeys(cells, ""), "R1 (nm)": "100"}]
        results.append(converted(run, rows, ending)[len(cells) + 1 :])
    assert results[0] == results[1]
    assert any("pull_off_force_" in text for text in results[0]) == (PARTS[columns] != "25 mJ/m2")


@pytest.mark.parametrize(
    ("header", "cells", "value"),
    [
        ("poisson [1],poisson_err [-]", ("0.2", "0.05"), Measured(0.2, 0.05, 0.05)),
        ("nu [-],nu_err", ("0.2", "0.05"), Measured(0.2, 0.05, 0.05)),
        ("nu,± [1]", ("0.2", "0.05"), Measured(0.2, 0.05, 0.05)),
        ("nu,nu_err [%]", ("0.2", "25"), Measured(0.2, 0.05, 0.05)),
        ("nu_min [1],nu_max [1]", ("0.1", "0.3"), Interval(0.2, 0.1, 0.3)),
        ("nu_min,nu_max [-]", ("0.1", "0.3"), Interval(0.2, 0.1, 0.3)),
    ],
)
def test_a_ratio_and_its_uncertainty_need_no_unit(header: str, cells: tuple[str, str], value: Any) -> None:
    (column,) = understood(header.split(",")).inputs
    assert column.value(column.joined(*cells)) == value


def converted(run: Run, rows: list[dict[str, str]], ending: str) -> list[str]:
    """Return the columns that a batch writes, each as a text."""
    out = f"out.{ending}"
    ran = run("batch", write_rows(rows, f"x.{ending}"), "--quantities", "pull_off_force", "-o", out)
    assert ran.code == 1, ran.err  # the second row has no value
    found = read_rows(out)
    return [f"{name}: {[row[name] for row in found]}" for name in found[0]]


@pytest.mark.parametrize(
    "other", ["gamma_err [mJ/m2]", "load_minus [nN]", "gamma_cv [%]", "U(γ) [mJ/m2]", "E_std [GPa]"]
)
def test_an_uncertainty_without_its_value_passes_through_or_is_refused(other: str) -> None:
    try:
        assert understood(["radius [nm]", other]).reading() == f"read: radius [nm]; passed through: {other}"
    except BadTable as error:
        assert "surface_energy" in str(error)


def test_the_reading_names_the_columns_of_an_uncertainty() -> None:
    said = understood(
        ["R1 (nm)", "R_err (nm)", "E_min [GPa]", "E_max [GPa]", "P [nN]", "P_plus [nN]", "P_minus [nN]"]
    ).reading()
    assert '''radius [nm] from "R1 (nm)" ± "R_err (nm)"''' in said
    assert "youngs_modulus [GPa] from E_min [GPa] to E_max [GPa]" in said
    assert "load [nN] from P [nN] − P_minus [nN] + P_plus [nN]" in said


# Columns that may be an uncertainty of γ, or qualify γ. If they passed through, results would lack an uncertainty.
_UNREAD = """
gamma_err_low | gamma_err_high [mJ/m2] | gamma_var | gamma_variance | gamma_cv | gamma_ci | gamma 95% CI | gamma_95ci |
gamma_sigma | gamma_iqr | gamma_q1 | gamma_mad [mJ/m2] | gamma_rel_err | relative error of gamma |
rel. std of gamma [mJ/m2] | gammaErr [mJ/m2] | gammaerr | std_γ_fit | SE |
error | σ | 95% CI | CI | lower | upper (95%) | variance | RSD | CV | ± (95% CI) | uncertainty (95%) | SD (95% CI) |
std (10%) | gamma ± (95% CI) | gamma_std (10 %) | uncertainty (95 percent) | U(γ) | U(γ) [mJ/m2] |
expanded uncertainty | gamma_minus | gamma_plus [mJ/m2] | gamma_min | gamma_max [mJ/m2] | gamma_lower |
gamma_minus [%] | gamma- | gamma+ [mJ/m2] | Δγ | Δγ [mJ/m2] | delta gamma | d_gamma [mJ/m2] | u_γ [mJ/m2] | gamma_mean |
gamma_median [mJ/m2] | gamma_n | gamma_old | gamma_in | gamma_u | gamma_3 [mJ/m2] | se(gamma) |
stderr(γ), mJ/m2 | deviation of gamma | errors_gamma | range of gamma | accuracy (gamma) % | gamma-error [mJ/m2] |
 gamma (fit) [mJ/m2] | gamma (k=2) | Fehler | Erreur | erweiterte Unsicherheit | γ-Fehler [mJ/m2]
"""


@pytest.mark.parametrize("other", " ".join(_UNREAD.split()).split(" | "))
def test_a_column_that_qualifies_an_input_passes_through_only_by_option_column(other: str) -> None:
    for heads in (["radius [nm]", "gamma [mJ/m2]", other], ["gamma [mJ/m2]", other, "radius [nm]", "radius_err"]):
        with pytest.raises(BadTable, match=re.escape(f"--column '{other}=' to pass it through")):
            understood(heads, [["25"] * len(heads)])
        header = understood(heads, [["25"] * len(heads)], stated_meanings([f"{other}="]))
        assert header.reading().replace('"', "").endswith(f"; passed through: {other}")


@pytest.mark.parametrize(
    ("heads", "other"),
    [
        (["R1 (nm)", "R_err"], "R_min"),
        (["E [J]", "E_err"], "E_max"),
        (["speed [m/s]"], "v_cv"),
        (["radius [nm]", "radius_err"], "radius_sd"),
        (["radius [nm]", "radius_err"], "radius_plus"),
        (["radius_min [nm]", "radius_max [nm]"], "radius_err"),
        (["tip [um]"], "tip_std [um]"),
        (["tip [um]"], "tip_95ci"),
    ],
)
def test_an_uncertainty_that_is_not_read_does_not_pass_through(heads: list[str], other: str) -> None:
    stated = stated_meanings(["tip [um]=radius [um]"] if "tip [um]" in heads else [])
    understood(heads, [], stated)
    with pytest.raises(BadTable, match=re.escape(f"--column '{other}='")):
        understood([*heads, other], [], stated)


def test_the_uncertainty_of_an_ambiguous_symbol_belongs_to_the_input_in_the_table() -> None:
    (column,) = understood(["E [J]", "E_err"]).inputs
    assert (column.name, column.sides) == ("energy", (("both", 1),))


def test_a_coverage_factor_is_asked_for_and_read() -> None:
    heads = ["gamma [mJ/m2]", "U(γ)"]
    with pytest.raises(BadTable, match=re.escape("--column 'U(γ)=surface_energy_err [mJ/m2] (k=K)', or")):
        understood(heads)
    (column,) = understood(heads, [], stated_meanings(["U(γ)=surface_energy_err [mJ/m2] (k=2)"])).inputs
    for cell in ("10", "1e1", "+10.0"):
        assert column.value(column.joined("25", cell)) == Measured(0.025, 0.005, 0.005)
    (column,) = understood(["gamma [mJ/m2]", "U(γ) [%] (k=1,96)"]).inputs
    found = column.value(column.joined("25", "39.2"))
    assert isinstance(found, Measured)
    assert [found.value, found.minus] == approx([0.025, 0.005], rel=1e-15)
    with pytest.raises(BadTable, match="must have the same coverage factor"):
        understood(["gamma [mJ/m2]", "gamma_minus (k=2)", "gamma_plus"])


def test_a_relative_error_of_a_percentage_in_per_cent_is_refused() -> None:
    """A value of 40 % with an error of 5 % may be 40 ± 2 % or 40 ± 5 %."""
    for other in ("filling_factor_rsd [%]", "relative error (%)", "CV of filling_factor [%]"):
        with pytest.raises(BadTable, match=re.escape(f"--column '{other}='")):
            understood(["filling_factor [%]", other])
    (column,) = understood(["filling_factor", "filling_factor_rsd [%]"]).inputs
    assert column.value(column.joined("0.4", "5")) == Measured(0.4, 0.02)


def test_per_cent_is_not_a_unit_of_length() -> None:
    """A radius cannot have a range in %, but a ratio can."""
    for given in ([], ["radius"]):
        with pytest.raises(BadTable, match=re.escape("'radius_min [%]' and 'radius_max [%]': ")):
            understood(["radius_min [%]", "radius_max [%]", "gamma [mJ/m2]"], given=given)
    (column,) = understood(["filling_factor_min [%]", "filling_factor_max [%]"]).inputs
    assert column.value(column.joined("10", "20")) == Interval(0.15, 0.1, 0.2)


def test_two_columns_of_the_same_name_may_pass_through_but_two_of_the_same_input_are_refused() -> None:
    assert understood(["a", "radius [nm]", "a"]).reading() == "read: radius [nm]; passed through: a"
    with pytest.raises(
        BadTable, match=re.escape("mean the same. Write --column 'R1 (um)=' or --column 'radius [nm]=' to")
    ):
        understood(["radius [nm]", "R1 (um)"])
    with pytest.raises(BadTable, match="mean the same: rename one"):
        understood(["radius [nm]", "radius [nm]"])


def test_an_uncertainty_in_another_unit_or_without_a_value_is_refused() -> None:
    with pytest.raises(BadTable, match=r"'P \[nN\]', 'P_minus \[uN\]' and 'P_plus \[nN\]' must have the same unit"):
        understood(["P [nN]", "P_plus [nN]", "P_minus [uN]"])
    with pytest.raises(BadRequest, match="is not its unit"):
        understood(["P [nN]", "P_err [nm]"], stated=stated_meanings(["P_err [nm]=load_err [nm]"]))
    with pytest.raises(BadTable, match="does not complete an uncertainty of surface_energy"):
        understood(["dG", "R1 (nm)"], stated=stated_meanings(["dG=surface_energy_err [mJ/m2]"]))
    header = understood(["gamma [mJ/m2]", "dG"], stated=stated_meanings(["dG=surface_energy_err [mJ/m2]"]))
    assert header.inputs[0].joined("25", "5") == "(25±5)"


# --- Materials --------------------------------------------------------------------------------------------------------


def test_an_unknown_material_is_a_label_if_the_row_has_all_inputs(run: Run) -> None:
    """Neither the material of an option nor, for sphere 2, the material of sphere 1 replaces an unknown material."""
    lines = [
        "Material,E_GPa,nu,R1 (um),gamma [mJ/m2]",
        "AISI 1020,200,0.29,1,50",
        "quartz,,,1,",
        "SiO2,70,0.17,1,25",
        "PTFE,,0.4,1,20",
    ]
    Path("x.csv").write_text("\n".join([*lines, ""]), encoding="utf-8")
    ran = run("batch x.csv --material quartz --quantities contact_radius -o out.csv")
    assert ran.code == 1
    assert "'SiO2' names several materials; write quartz" in ran.err
    found = [*csv.DictReader(Path("out.csv").read_text(encoding="utf-8").splitlines())]
    quartz = run("contact quartz 1um --bare --quantities contact_radius --quiet").out.strip()
    steel = run("contact 1um --young 200GPa --poisson 0.29 --gamma 50mJ/m2 --bare --quantities contact_radius --quiet")
    assert [row["contact_radius [m]"] for row in found][:2] == [steel.out.strip(), quartz]
    assert found[2]["contact_radius [m]"] != ""
    assert found[3]["status"] == "unknown material"
    assert "no material 'PTFE'" in ran.err

    Path("x.csv").write_text("material,material2,R1 (um)\nquartz,PTFE,1\n", encoding="utf-8")
    ran = run("batch x.csv --quantities contact_radius -o out.csv")
    assert ran.code == 1
    assert "no material 'PTFE'" in ran.err


def test_a_table_with_unknown_materials_has_the_quantities_that_follow_from_its_other_columns(run: Run) -> None:
    Path("x.csv").write_text("material,R1 (um),gamma [mJ/m2]\nA,1,25\nB,2,25\n", encoding="utf-8")
    assert run("batch x.csv -o out.csv").code == 0
    head, first, _ = Path("out.csv").read_text(encoding="utf-8").splitlines()
    assert "pull_off_force [N]" in head
    assert "contact_radius" not in head
    assert first.startswith("A,1,25,1.178097245096172")


# --- Delimiters and decimal marks -------------------------------------------------------------------------------------

PLAIN = ["name,R1 (um),gamma [mJ/m2],E [GPa],nu", "a,1.5,25.0,54,0.17", "b,2,3e1,70.5,0.2", "c,x,25,70,0.2"]
DIVIDED = [
    ("semicolon", ";", "csv"),
    ("bar", "|", "csv"),
    ("tab", "\t", "tsv"),
    ("comma", ",", "csv"),
    ("blank", "  ", "tsv"),
]


@pytest.mark.parametrize(
    ("word", "mark", "ending", "point"),
    [*((*divided, ".") for divided in DIVIDED), *((*divided, ",") for divided in DIVIDED if divided[0] != "comma")],
)
def test_the_delimiter_option_divides_columns(run: Run, word: str, mark: str, ending: str, point: str) -> None:
    head, *rows = PLAIN
    if word == "blank":
        head = "name,R1_um,gamma_mJ_m2,E_GPa,nu"
    text = [head.replace(",", mark), *(row.replace(",", mark).replace(".", point) for row in rows)]
    Path("x.txt").write_text("\n".join([*text, ""]), encoding="utf-8")
    Path("plain.csv").write_text("\n".join([*PLAIN, ""]), encoding="utf-8")
    words = "--quantities pull_off_force,contact_radius --quiet"
    assert run(f"batch plain.csv -o plain.out.csv {words}").code == 1
    assert run(f"batch x.txt --delimiter {word} -o out.{ending} {words}").code == 1
    expected = [line.split(",")[5:7] for line in Path("plain.out.csv").read_text(encoding="utf-8").splitlines()[1:]]
    divider = "\t" if word == "blank" else mark
    found = [line.split(divider) for line in Path(f"out.{ending}").read_text(encoding="utf-8").splitlines()[1:]]
    assert [[cell.replace(point, ".") for cell in row[5:7]] for row in found] == expected
    assert [row[:5] for row in found] == [row.split(mark) for row in text[1:]]
    assert point in found[0][5]


def test_a_row_that_begins_with_a_comment_mark_fails(run: Run) -> None:
    """Only the header, the lines above it and a row of units may begin with #."""
    Path("x.txt").write_text("# R1_nm name\n#100 a\n200 b\n", encoding="utf-8")
    assert run("batch x.txt --delimiter blank --material quartz -o out.tsv --quantities pull_off_force").code == 1
    _, marked, row = Path("out.tsv").read_text(encoding="utf-8").splitlines()
    assert marked.endswith("bad radius")
    assert row.startswith("200\tb\t2.35")


def test_numbers_and_error_bars_but_not_labels_decide_if_commas_are_decimal(run: Run) -> None:
    """With --excel-safe, a negative number with a decimal comma is not taken for a formula."""
    Path("labels.tsv").write_text("label\tradius [nm]\tgamma [mJ/m2]\n0,5\t100.5\t25\nB\t200\t25\n", encoding="utf-8")
    assert run("batch labels.tsv --quantities pull_off_force -o out.tsv --no-doubt").code == 0
    _, *rows = Path("out.tsv").read_text(encoding="utf-8").splitlines()
    assert all(float(row.split("\t")[3]) > 0 for row in rows)
    Path("bars.csv").write_text(
        "radius [nm];gamma [mJ/m2]\n100;25,5±0,5\n100;20,5 to 30,5\n100;25±1.5\n", encoding="utf-8"
    )
    assert run("batch bars.csv --delimiter semicolon --quantities pull_off_force -o out.csv").code == 1
    bar, ends, point = Path("out.csv").read_text(encoding="utf-8").splitlines()[1:]
    assert bar.split(";")[2:5] == ["1,2016591899980957e-8", "2,356194490192358e-10", "2,356194490192358e-10"]
    assert ends.split(";")[2] == "1,2016591899980957e-8"
    assert "'25±1.5' has a point" in point
    Path("safe.csv").write_text("material;radius [nm];approach [nm]\nquartz;100,5;0,05\n", encoding="utf-8")
    assert run("batch safe.csv --delimiter semicolon --excel-safe --quantities load --no-doubt -o out.csv").code == 0
    assert ";-6,58" in Path("out.csv").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("rows", "forces"),
    [
        # Forces are in units of 1.5 πγ·1 nm. Points are decimal points, and a cell with a thousands separator fails.
        (["1,200\t25.5", "800\t25.5"], ["", "800"]),
        (["800\t25\t12,31", "900\t25\t14,7"], ["800", "900"]),
        (["800\t25\t1,200", "900\t25\t12,345"], ["800", "900"]),
        (["1.200\t25", "1.300\t25"], ["1.2", "1.3"]),
        (["800\t25\t1.234,5", "1.20\t25\t3"], ["800", "1.2"]),
        (["1,234,567\t25", "800\t25"], ["", "800"]),
        # Commas are decimal commas, and a cell with a thousands separator fails.
        (["850,5\t25", "1.200\t25"], ["850,5", ""]),
        (["0,125\t25", "1,200\t25"], ["0,125", "1,2"]),
        (["1,234E2\t25", "2,345E2\t25"], ["123,4", "234,5"]),
    ],
)
def test_thousands_separators_are_not_read_as_decimal_marks(run: Run, rows: list[str], forces: list[str]) -> None:
    """Even if the inputs have no decimal mark, a column that passes through does not decide which mark is decimal."""
    width = 1 + rows[0].count("\t")
    lines = ["\t".join(["R1 (nm)", "gamma (mJ/m2)", "n"][:width]), *rows, ""]
    Path("x.tsv").write_text("\n".join(lines), encoding="utf-8")
    ran = run("batch x.tsv --quantities pull_off_force --no-doubt -o out.tsv")
    assert ran.code == ("" in forces), ran.err
    gamma = 0.0255 if "25.5" in rows[0] else 0.025
    found_rows = Path("out.tsv").read_text(encoding="utf-8").splitlines()[1:]
    for row, force in zip(found_rows, forces, strict=True):
        found = row.split("\t")[width]
        mark = "," if "," in found else "."
        assert bool(found) == bool(force)
        if found:
            radius = 1e-9 * float(force.replace(",", "."))
            assert float(found.replace(mark, ".")) == approx(1.5 * pi * gamma * radius)


@pytest.mark.parametrize("label", ["1234,5", "1,200", "1.5"])
def test_marks_in_an_unread_column_do_not_decide_which_mark_is_decimal(run: Run, label: str) -> None:
    Path("x.csv").write_text(f"R1 (nm);gamma (mJ/m2);n\n100;25;{label}\n", encoding="utf-8")
    words = "batch x.csv -o out.csv --delimiter semicolon --quantities pull_off_force --no-doubt"
    assert run(words).code == 0
    row = Path("out.csv").read_text(encoding="utf-8").splitlines()[1]
    assert row == f"100;25;{label};1.1780972450961723e-8;"
    Path("x.csv").write_text(f"R1 (nm);gamma (mJ/m2);n\n1.200;25;{label}\n", encoding="utf-8")
    assert run(words) == (2, "", "jkroll: '1.200' may be 1.200 or 1200: write 1.2000, with one more digit, or 1200\n")


@pytest.mark.parametrize(("word", "mark", "end"), [("semicolon", ";", "csv"), ("tab", "\t", "tsv")])
def test_a_point_that_may_separate_thousands_is_refused_even_below_the_first_rows(
    run: Run, word: str, mark: str, end: str
) -> None:
    """The radii rise from 800 to 999 nm, and the next one is 1.000. A column that passes through has decimal commas."""
    rows = [f"{800 + row};25;0,5" for row in range(200)] + ["1.000;25;0,5", "1.000 nm;25;0,5", "1000.5;25;0,5"]
    text = "\n".join(["R1 (nm);gamma (mJ/m2);n", *rows, ""]).replace(";", mark)
    Path("x.tsv").write_text(text, encoding="utf-8")
    assert run(f"batch x.tsv -o out.{end} --delimiter {word} --quantities pull_off_force --no-doubt").code == 1
    cells = [line.split(mark) for line in Path(f"out.{end}").read_text(encoding="utf-8").splitlines()[1:]]
    assert [row for row, found in enumerate(cells) if not found[3]] == [200, 201]
    assert cells[200][4] == "'1.000' may be 1.000 or 1000: write 1.0000, with one more digit, or 1000"
    assert float(cells[202][3]) == approx(1.5 * pi * 0.025 * 1000.5e-9)
    rows[0] = "1.000;25;0,5"
    Path("x.tsv").write_text("\n".join(["R1 (nm);gamma (mJ/m2);n", *rows, ""]).replace(";", mark), encoding="utf-8")
    ran = run(f"batch x.tsv -o out.{end} --delimiter {word} --quantities pull_off_force --no-doubt")
    assert (ran.code, "'1.000' may be 1.000 or 1000" in ran.err) == (2, True)


@pytest.mark.parametrize("header", ["radius / Å", "radius / Å,à", "à,radius / Å", "radius / Å,x\xa0"])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_a_header_may_end_in_any_letter(run: Run, header: str, end: str) -> None:
    """In UTF-8, Å, à and a no-break space end in the byte 85 or A0, which is a blank in other encodings."""
    cells = ",".join("1000" for _ in header.split(","))
    Path("x.csv").write_text(f"{header}{end}{cells}{end}", encoding="utf-8", newline="")
    assert run("batch x.csv -o out.csv --gamma 25mJ/m2 --quantities pull_off_force --no-doubt").code == 0
    lines = Path("out.csv").read_text(encoding="utf-8").splitlines()
    assert lines[1].split(",")[-2] == "1.1780972450961723e-8"


def test_commas_in_an_unread_column_between_tabs_are_not_taken_for_decimal_commas(run: Run) -> None:
    """Such commas may separate the items of a list. A number below the first rows keeps its point."""
    rows = ["R1 (nm)\tgamma (mJ/m2)\tplace", *["100\t25\t1,5"] * 200, "100.5\t25\t2,5", ""]
    Path("x.tsv").write_text("\n".join(rows), encoding="utf-8")
    assert run("batch x.tsv -o out.tsv --quantities pull_off_force --no-doubt").code == 0
    assert Path("out.tsv").read_text(encoding="utf-8").splitlines()[1] == "100\t25\t1,5\t1.1780972450961723e-8\t"


@pytest.mark.parametrize("words", ["", "--infer gamma --measured pull_off_force --radius2 plane"])
def test_a_table_whose_commas_may_separate_thousands_is_refused(run: Run, words: str) -> None:
    other = "P_c (nN)" if words else "gamma (mJ/m2)"
    Path("x.tsv").write_text(f"R1 (nm)\t{other}\n800\t1,200\n900\t12,500\n", encoding="utf-8")
    message = "jkroll: '1,200' may be 1.200 or 1200: write 1,2000, with one more digit, or 1200\n"
    assert run(f"batch x.tsv -o out.tsv {words}") == (2, "", message)
    Path("x.csv").write_text(f'R1 (nm),{other}\n"1.234","25,5"\n"2.500",20\n', encoding="utf-8")
    assert "decimal commas between commas" in run(f"batch x.csv -o out.csv {words}").err


@pytest.mark.parametrize("quote", ["", '"'])
def test_a_point_among_decimal_commas_is_refused(run: Run, quote: str) -> None:
    """The point may separate thousands."""
    cells = ["2,5;1200,5", "2,5;1.200", "2.5;1200", "2,5;1.200,5", "2,5;1200"]
    rows = [f"{quote}{row}{quote}".replace(";", f"{quote};{quote}") for row in cells]
    Path("x.csv").write_text("\n".join(["radius [um];gamma [mJ/m2]", *rows, ""]), encoding="utf-8")
    ran = run("batch x.csv --delimiter ; --quantities pull_off_force --no-doubt -o out.csv")
    assert ran.code == 1
    written = Path("out.csv").read_text(encoding="utf-8")
    forces = [line.replace('"', "").split(";")[2] for line in written.splitlines()[1:]]
    assert [bool(force) for force in forces] == [True, False, False, False, True]
    assert "'1.200' has a point: this table has decimal commas, and no thousands separators" in written


@pytest.mark.parametrize(
    ("text", "remedy"),
    [
        ("radius [nm];gamma [mJ/m2]\n1;2\n", "--delimiter semicolon"),
        ("radius_nm gamma_mJ_m2\n1 2\n", "--delimiter blank"),
        ("radius [nm]|gamma [mJ/m2]\n1|2\n", "--delimiter bar"),
    ],
)
def test_a_separator_other_than_the_comma_is_named(run: Run, text: str, remedy: str) -> None:
    Path("x.csv").write_text(text, encoding="utf-8")
    ran = run("batch x.csv -o out.csv")
    assert (ran.code, remedy in ran.err) == (2, True), ran.err
    out = "out.tsv" if "blank" in remedy else "out.csv"
    assert run(f"batch x.csv {remedy} --quantities pull_off_force -o {out}").code == 0


def test_a_quantity_that_some_rows_show_is_shown_in_all_rows(run: Run) -> None:
    Path("x.csv").write_text("material,radius [nm],load [nN]\nquartz,100,\nquartz,100,0\n", encoding="utf-8")
    assert run("batch x.csv -o out.csv").code == 0
    with Path("out.csv").open(encoding="utf-8") as file:
        empty, zero = csv.DictReader(file)
    assert empty["yield_force_fixed_load [N]"]
    assert {**empty, "load [nN]": "0"} == zero


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            "--material quartz --quantities yield_force",
            "assumed: ξ = 200 pm (--xi), no load (--load)",
        ),
        ("--material quartz --quantities yield_force --xi 1nm --load 0N", ""),
        ("--material quartz --quantities pull_off_force", ""),
        ("--material quartz --quantities pull_off_force --z0 4angstrom", ""),
        ("--material quartz --quantities pull_off_force --no-doubt", ""),
        ("--material quartz --quantities contact_radius_at_load", "assumed: no load (--load)"),
        ("--materials own.toml --material own --quantities yield_force", "assumed: no load (--load)"),
    ],
)
def test_assumptions_are_reported_for_one_table_and_for_many(run: Run, words: str, said: str) -> None:
    own = '[materials.own]\nsurface_energy = "25 mJ/m2"\nyield_displacement = { value = "2 nm", radius = "1 um" }\n'
    Path("own.toml").write_text(own, encoding="utf-8")
    Path("in").mkdir()
    for name in "ab":
        Path(f"in/{name}.csv").write_text("R1 (um)\n1\n", encoding="utf-8")
    for table in ("in/a.csv -o out.csv", "in/*.csv -o out/"):
        lines = run(f"batch {table} {words}").err.splitlines()
        assert [line for line in lines if "assumed" in line] == ([said] if said else [])


def test_an_option_for_one_sphere_goes_with_a_column_for_the_other_sphere(run: Run) -> None:
    Path("a.csv").write_text("R1 (um),gamma2 (mJ/m2)\n1,30\n", encoding="utf-8")
    ran = run("batch a.csv -o out.csv --gamma 25mJ/m2 --quantities pull_off_force")
    assert (ran.code, "assumed: w = " in ran.err) == (0, True), ran.err


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("radius R1 (nm),gamma (mJ/m2)\n100,25\n", 'read: radius [nm] from "radius R1 (nm)", surface'),
        ("radius [nm],gamma_sv (mJ/m2)\n100,25\n", "may be surface_energy"),
        ("Radius,Surface energy,n\n(nm),(mJ/m2),1\n100,25,2\n", "the row below holds units, not values"),
        ("R1 (nm),gamma (mJ/m2),gamma_sem (mJ/m2)\n100,25,2\n", '± "gamma_sem (mJ/m2)"'),
        ("R1 (nm),SEM,gamma (mJ/m2)\n100,image1.tif,25\n", "passed through: SEM"),
        ("R1 (nm),SEM,gamma (mJ/m2)\n100,5,25\n", "± SEM"),
    ],
)
def test_the_reading_of_a_header_is_reported(run: Run, text: str, said: str) -> None:
    Path("x.csv").write_text(text, encoding="utf-8")
    assert said in run("batch x.csv -o out.csv --quantities pull_off_force").err.replace("\n  ", " ")


def test_empty_columns_without_a_name_pass_through(run: Run) -> None:
    """A spreadsheet leaves such columns on the right."""
    Path("x.csv").write_text("R1 (nm);gamma (mJ/m2);;;\n100;25;;;\n", encoding="utf-8")
    ran = run("batch x.csv -o out.csv --delimiter semicolon --quantities pull_off_force --no-doubt")
    assert (ran.code, "passed through" in ran.err) == (0, False)
    assert Path("out.csv").read_text(encoding="utf-8").splitlines()[1].startswith("100;25;;;;1.178")


def test_a_number_too_small_for_a_double_is_not_zero(run: Run) -> None:
    """A row with such a number fails. A load of 0 and a tiny load that fits a double are read."""
    Path("x.csv").write_text("radius [nm],load [nN]\n100,1\n100,1e-400\n100,0\n100,1e-290\n", encoding="utf-8")
    assert run("batch x.csv -o out.csv --material quartz --quantities contact_radius_at_load --no-doubt").code == 1
    statuses = [line.partition(",,")[2] for line in Path("out.csv").read_text(encoding="utf-8").splitlines()[1:]]
    assert [bool(status) for status in statuses] == [False, True, False, False]


@pytest.mark.parametrize("blank", ["\xa0", "\u202f", "\u2009", "  "])
def test_a_blank_after_a_number_is_not_a_unit(blank: str) -> None:
    (column,) = understood(["nu [%]"]).inputs
    for cells in ([f"0.3{blank}"], ["0.2", f"0.3{blank}"], [f"0.3{blank}"] * 2):
        assert column.numbers({column.name: [cell.encode() for cell in cells]}).values[-1] == 0.003


def test_a_label_that_is_an_alias_of_a_material_is_reported(run: Run) -> None:
    Path("x.csv").write_text("material,R1 (nm),gamma (mJ/m2)\nA,100,25\nC,100,25\n", encoding="utf-8")
    ran = run("batch x.csv -o out.csv --quantities pull_off_force --no-doubt")
    assert (ran.code, ran.err.count("note: material 'C' is graphite")) == (0, 1)
    lines = ["material,material2,R1 (nm),gamma (mJ/m2),gamma2 (mJ/m2)", "A,B,100,25,25", "C,C,100,25,25", ""]
    Path("x.csv").write_text("\n".join(lines), encoding="utf-8")
    ran = run("batch x.csv -o out.csv --quantities pull_off_force --no-doubt")
    assert (ran.code, ran.err.count("note: material 'C' is graphite")) == (0, 1)
    Path("x.csv").write_text("material,R1 (nm),gamma (mJ/m2)\nC,100,25\n", encoding="utf-8")
    assert "is graphite" not in run("batch x.csv -o out.csv --quantities pull_off_force --no-doubt").err


def test_a_header_between_rows_is_a_failed_row(run: Run) -> None:
    """A header stands between rows if two tables were joined."""
    Path("x.csv").write_text("n,R1 (nm),gamma (mJ/m2)\n1,100,25\nn,R1 (nm),gamma (mJ/m2)\n1,200,25\n", encoding="utf-8")
    assert run("batch x.csv -o out.csv --quantities pull_off_force --no-doubt").code == 1
    assert Path("out.csv").read_text(encoding="utf-8").splitlines()[2].endswith(",,bad radius")


def test_an_option_for_an_input_with_a_column_is_reported(run: Run) -> None:
    """In a command for one contact, an option overrides the material. In a table, a cell overrides an option."""
    Path("x.csv").write_text("radius [nm],gamma [mJ/m2]\n100,25\n100,\n", encoding="utf-8")
    words = "batch x.csv -o out.csv --quantities pull_off_force --no-doubt --gamma 50mJ/m2"
    assert "note: --gamma fills empty cells: other cells keep theirs\n" in run(words).err
    assert "note: --radius fills empty cells" in run(f"{words} --radius 1um").err
    forces = [float(line.split(",")[2]) for line in Path("out.csv").read_text(encoding="utf-8").splitlines()[1:]]
    assert forces[1] == approx(2 * forces[0], rel=1e-12)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--density 2g/cm3 --quantities pull_off_force", "note: --density changes no result here\n"),
        (
            "--density 2g/cm3 --gravity 3m/s2 --quantities r_min",
            "note: --density and --gravity change no result here\n",
        ),
        ("--density 2g/cm3 --quantities n_grav", ""),
        ("--z0 3angstrom --quantities pull_off_force", ""),
        ("--z0 3angstrom --quantities pull_off_force --young 1GPa --poisson 0.3 --model maugis --no-doubt", ""),
        ("--young inf --quantities pull_off_force --no-doubt", ""),
        ("--z0 3angstrom --quantities pull_off_force --no-doubt", "note: --z0 changes no result here\n"),
    ],
)
def test_an_option_that_changes_nothing_is_reported(run: Run, words: str, said: str) -> None:
    Path("x.csv").write_text("R1 (nm),gamma (mJ/m2)\n100,25\n", encoding="utf-8")
    err = run(f"batch x.csv -o out.csv {words}").err
    assert said in err
    assert ("no result here" in err) == bool(said)


@pytest.mark.parametrize("kind", ["csv", "ndjson"])
def test_piped_input_is_not_taken_for_compressed_if_the_output_is_compressed(kind: str) -> None:
    target = f"out.{kind}.gz"
    assert input_format("-", target) == format_of_name(f"x.{kind}")
    assert output_format(target, kind, quiet=True) == format_of_name(target)
    assert input_format("-", target, f"{kind}.gz") == format_of_name(target)


def test_the_comment_mark_of_a_header_may_follow_a_byte_order_mark(run: Run) -> None:
    Path("x.txt").write_bytes(b"\xef\xbb\xbf# R1_nm gamma_mJ_m2\n100 25\n")
    assert run("batch x.txt --delimiter blank -o out.tsv --quantities pull_off_force --no-doubt").code == 0
    assert Path("out.tsv").read_text(encoding="utf-8").splitlines()[1].startswith("100\t25\t1.178")


@pytest.mark.parametrize(("head", "cell"), [("RH", "0.6"), ("RH", "60%"), ("RH [%]", "60"), ("RH_percent", "60")])
def test_a_column_rh_is_the_relative_humidity(run: Run, head: str, cell: str) -> None:
    Path("x.csv").write_text(f"material,radius [nm],{head}\nquartz,100,{cell}\n", encoding="utf-8")
    assert run("batch x.csv -o out.csv --quantities F_men --no-doubt").code == 0
    assert Path("out.csv").read_text().splitlines()[1] == f"quartz,100,{cell},4.2692409913092435e-8,"


@pytest.mark.parametrize(
    ("head", "said"),
    [
        (
            "RH",
            "'RH' (first cell '60'): no unit in the header or in the first cell. Write --column 'RH=humidity [%]'",
        ),
        ("Rh [nm]", "passed through: Rh [nm]"),  # a hydrodynamic radius
        ("Rh [%]", "passed through: Rh [%]"),  # rhodium
    ],
)
def test_rh_as_a_percentage_needs_its_unit_and_rh_with_a_small_h_is_not_the_humidity(
    run: Run, head: str, said: str
) -> None:
    Path("x.csv").write_text(f"material,radius [nm],{head}\nquartz,100,60\n", encoding="utf-8")
    assert said in " ".join(run("batch x.csv -o out.csv --quantities P_c").err.split())
