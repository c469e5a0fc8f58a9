"""Unread columns do not pass through if another number would silently replace their values; all advice works."""

import re
import shlex
from pathlib import Path

import pytest

from harness import Run
from meant_headers import IDLE, MISLED, MISREAD, PASSED, REFUSED, Header, advice_for, groups_of, meant_headers, outcome
from relative import approx

OTHERS = "material,radius [nm]"  # the other columns; the material is quartz
ADVISED = {
    "Interface Energy (J/m^2)": "work_of_adhesion [J/m^2]",
    "dens. of solid (g/cm3)": "density [g/cm3]",
    "impact vel (m/s)": "speed [m/s]",
    "elast 2 (GPa)": "youngs_modulus2 [GPa]",
    "crit. displacement [nm]": "yield_displacement [nm]",
    "F_set (nN)": "load [nN]",
    "sample surface energy (mJ/m2)": "surface_energy [mJ/m2]",
    "E (lit.) (GPa)": "youngs_modulus [GPa]",
    "E DFT (GPa)": "youngs_modulus [GPa]",
    "rho lit. (g/cm3)": "density [g/cm3]",
    "w lit. (mJ/m2)": "work_of_adhesion [mJ/m2]",
    "gamma model (mJ/m2)": "surface_energy [mJ/m2]",
    "R2um": "radius2 [um]",
    "R2micron": "radius2 [micron]",
    "equivalent radius [nm]": "reduced_radius [nm]",
}
PASSING = (
    "stiffness [N/m]", "hertz_pressure [Pa]", "lost_energy [J]", "hardness (GPa)", "yield stress (MPa)", "x [um]",
    "spring constant (N/m)", "height (nm)", "pull-off force (nN)", "heat of fusion (J)", "sound speed (m/s)", "T [K]",
    "equivalent diameter (um)", "particle hydrodynamic radius (nm)", "Ra (nm)", "areal density (g/cm2)", "E index",
    "tensile strength (MPa)", "binding energy (kT)", "size [px]",
    "time [s]", "contact radius (nm)", "roughness Rq (nm)", "wavelength_nm", "tap rho_b (kg/m3)", "material_id",
)  # fmt: skip


def ran(run: Run, heads: str, cells: str, options: str = "", path: str = "x.csv") -> str:
    """Return the exit code and the messages of `batch` for a table."""
    Path(path).write_text(f"{heads}\n{cells}\n", encoding="utf-8")
    found = run("batch", path, *shlex.split(options), "-o", "out.csv")
    return f"{found.code}: {found.err}"


@pytest.fixture(autouse=True)
def _wide(monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep the lines of messages unbroken."""
    monkeypatch.setenv("COLUMNS", "2000")


@pytest.mark.parametrize("head", ADVISED)
def test_a_possible_input_is_refused_with_advice_that_works(run: Run, head: str) -> None:
    said = ran(run, f"{OTHERS},{head}", "quartz,100,3")
    assert said.startswith("2: ")
    advised = [shlex.split(word)[0] for word in re.findall(r"--column ('[^']*')", said)]
    assert f"{head}={ADVISED[head]}" in advised
    assert f"{head}=" in advised
    assert ran(run, f"{OTHERS},{head}", "quartz,100,3", shlex.join(["--column", f"{head}={ADVISED[head]}"]))[0] in "01"


@pytest.mark.parametrize("head", PASSING)
def test_a_column_of_another_quantity_passes_through(run: Run, head: str) -> None:
    assert f"passed through: {head}" in ran(run, f"{OTHERS},{head}", "quartz,100,3").replace('"', "")


def test_messages_name_the_value_used_instead(run: Run) -> None:
    said = ran(run, "material,radius [nm],foo (GPa),bar (g/cm3)", "quartz,100,3,2", "--density 2g/cm3")
    assert "'foo (GPa)' (first cell '3'): not read, and E is the material's" in said
    assert "'bar (g/cm3)' (first cell '2'): not read, and ρ is --density 2g/cm3" in said
    options = "--density 2g/cm3 --pass-rest --quantities pull_off_force,mass"
    said = ran(run, "material,radius [nm],foo (GPa),bar (g/cm3)", "quartz,100,3,2", options)
    assert '"foo (GPa)", "bar (g/cm3)" (ρ is --density 2g/cm3)' in said  # no result depends on E


def test_messages_name_the_value_from_which_an_input_follows(run: Run) -> None:
    said = ran(run, f"{OTHERS},interfacial energy [mJ/m2]", "quartz,100,20")
    assert "not read, and w follows from γ2, which is that of sphere 1. Write" in said
    said = ran(run, f"{OTHERS},impact vel (m/s)", "quartz,100,20")
    assert "not read, and v follows from W0/P_cδ0, which is 1 by default. Write" in said


def test_all_possible_diameters_are_refused_together(run: Run) -> None:
    """If only d1 were read, its value would replace that of d2, whose unit is unknown."""
    said = ran(run, "d1 [um],d2 [mikrometer],gamma [mJ/m2]", "4.91,10.98,35.9", "--quantities pull_off_force")
    assert said == (
        "2: jkroll: header: 'd1 [um]' (first cell '4.91'): it may be a diameter; 'd2 [mikrometer]' "
        "(first cell '10.98'): not read, and D2 is that of sphere 1. Write --column 'd1 [um]=diameter [um]' "
        "--column 'd2 [mikrometer]=diameter2 [UNIT]', or --column 'd1 [um]=' --column 'd2 [mikrometer]=' to pass them "
        "through (--pass-rest passes all unread columns)\n"
    )


@pytest.mark.parametrize(
    ("head", "meant"),
    [("d2 [mikrometer]", "diameter2 [UNIT]"), ("R2 [mikrometer]", "radius2 [UNIT]"),
     ("d2 in Mikrometern", "diameter2 [UNIT]"), ("d2 [µ]", "diameter2 [UNIT]"), ("R2_mikrometer", "radius2 [UNIT]"),
     ("E [kg/mm2]", "youngs_modulus [UNIT]"), ("modulus (t/cm2)", "youngs_modulus [UNIT]"),
     ("rho [g/cm]", "density [UNIT]"), ("ρ (g/cm²)", "density [UNIT]"), ("A_H (kT)", "hamaker [UNIT]"),
     ("Er", "contact_modulus [UNIT]"), ("E*", "contact_modulus [UNIT]"),
     ("rho [g/ccm]", "density [UNIT]"), ("E wall [kN/qmm]", "youngs_modulus2 [UNIT]"), ("P [kp]", "load [UNIT]")],
)  # fmt: skip
def test_a_symbol_with_an_unknown_unit_is_refused(run: Run, head: str, meant: str) -> None:
    said = ran(run, f"material,radius [um],{head}", "quartz,1,3")
    assert said.startswith(f"2: jkroll: header: '{head}' (first cell '3'): not read, and ")
    assert f"Write --column '{head}={meant}'" in said


@pytest.mark.parametrize("head", ["R2", "R2 [-]", "rho [ohm m]", "A [mm^2]", "P [mbar]", "E [kcal/mol]"])
def test_a_symbol_without_a_unit_or_with_that_of_another_quantity_passes_through(run: Run, head: str) -> None:
    assert f"passed through: {head}" in ran(run, f"material,radius [um],{head}", "quartz,1,3").replace('"', "")


SECOND_RADII = """R(2)|sphere j radius|grain j radius|particle B radius|other sphere radius|host sphere radius|RB|R*|
large grain radius|large sphere diameter|Reff|R_eff|Rred|Req|R2 lit.|big sphere radius|harmonic mean radius"""


@pytest.mark.parametrize("head", " ".join(SECOND_RADII.split()).replace("| ", "|").split("|"))
def test_a_second_radius_is_refused_unless_the_table_has_both(run: Run, head: str) -> None:
    said = ran(run, f"radius [um],{head} (um),gamma [mJ/m2]", "1,50,25", "--quantities pull_off_force")
    assert said.startswith(f"2: jkroll: header: '{head} (um)' (first cell '50'): ")
    said = ran(run, f"radius [um],radius2 [um],{head} (um),gamma [mJ/m2]", "1,50,25,25", "--quantities pull_off_force")
    assert f"passed through: {head} (um)" in said.replace('"', "")


@pytest.mark.parametrize(
    ("head", "option", "meant"),
    [
        ("σ_y (MPa)", "--yield-strength 1GPa", "yield_strength [MPa]"),
        ("sigma_y (GPa)", "--yield-strength 1GPa", "yield_strength [GPa]"),
        ("yield stress (MPa)", "--yield-strength 1GPa", "yield_strength [MPa]"),
        ("rh (%)", "--humidity 30%", "humidity [%]"),
        ("RH%", "--humidity 30%", "humidity"),
    ],
)
def test_a_column_in_place_of_which_an_option_would_be_used_is_refused(
    run: Run, head: str, option: str, meant: str
) -> None:
    said = ran(run, f"{OTHERS},speed [m/s],{head}", "quartz,100,1,50", f"{option} --quantities v_y,meniscus_force")
    assert said.startswith(f"2: jkroll: header: '{head}' (first cell '50'): not read, and ")
    assert f"is {option}. Write --column '{head}={meant}', or" in said


@pytest.mark.parametrize("head", ["θ (°)", "theta_deg", "angle [°]"])
def test_an_angle_in_humid_air_is_refused_unless_it_is_clear(run: Run, head: str) -> None:
    """It would be read as the angle of rolling, and the contact angle of water would be 0 by default."""
    options = "--quantities meniscus_force,roll_energy"
    for columns, cells, option in ((f"{OTHERS},RH (%)", "quartz,100,50", ""), (OTHERS, "quartz,100", "--humidity 50%")):
        said = ran(run, f"{columns},{head}", f"{cells},20", f"{option} {options}")
        assert f"'{head}' (first cell '20'): with a humidity it may be the contact angle of water. Write" in said
        for name in ("contact_angle", "rolling_angle"):
            way = re.search(rf"--column '[^']*={name} [^']*'", said)
            assert way
            assert f"{name} [" in ran(run, f"{columns},{head}", f"{cells},20", f"{option} {options} {way[0]}")
    assert "rolling_angle [" in ran(run, f"{OTHERS},{head}", "quartz,100,20", "--quantities roll_energy")


def test_a_column_on_which_no_result_depends_passes_through(run: Run) -> None:
    """A pull-off force depends on the reduced radius and w only."""
    said = ran(run, f"{OTHERS},bar (g/cm3),foo (m/s)", "quartz,100,2,3", "--quantities pull_off_force")
    assert said.startswith("0: ")


@pytest.mark.parametrize("columns", ["youngs_modulus [GPa],youngs_modulus2 [GPa]", "contact_modulus [GPa]"])
def test_an_unread_modulus_passes_through_if_other_columns_give_all_moduli(run: Run, columns: str) -> None:
    cells = ",".join(["5"] * len(columns.split(",")))
    assert "'foo" not in ran(run, f"{OTHERS},{columns},foo (GPa)", f"quartz,100,{cells},3")


def test_an_unread_column_with_units_of_an_input_in_its_cells_is_refused(run: Run) -> None:
    said = ran(run, f"{OTHERS},adhesive", "quartz,100,25 mJ/m2")
    assert "'adhesive' (first cell '25 mJ/m2'): not read" in said


@pytest.mark.parametrize(("head", "name"), [("Werkstoff", "material2"), ("wall", "material2"), ("what", "material2")])
def test_an_unread_column_of_materials_is_refused(run: Run, head: str, name: str) -> None:
    said = ran(run, f"{OTHERS},{head}", "quartz,100,iron")
    assert f"Write --column '{head}={name}', or --column '{head}='" in said
    assert ran(run, f"radius [nm],{head}", "100,iron").startswith("2: ")


def test_labels_and_letters_are_not_materials(run: Run) -> None:
    """A header such as grade labels its cells, even if they name a material."""
    assert ran(run, f"{OTHERS},grade", "quartz,100,iron").startswith("0: ")
    assert ran(run, f"{OTHERS},foo", "quartz,100,iron").startswith("2: ")
    assert ran(run, f"{OTHERS},foo", "quartz,100,C").startswith("0: ")


def test_a_column_of_materials_passes_through_only_if_columns_give_the_properties_of_both_spheres(run: Run) -> None:
    heads = "radius [nm],gamma [mJ/m2],E [GPa],nu,rho [kg/m3]"
    both = f"{heads},radius2 [nm],gamma2 [mJ/m2],E2 [GPa],nu2,rho2 [kg/m3]"
    assert ran(run, f"{both},name", f"{','.join(['100,25,54,0.2,2600'] * 2)},quartz").startswith("0: ")
    assert "its cells are materials" in ran(run, f"{heads},name", "100,25,54,0.2,2600,quartz")


def test_columns_that_batch_has_added_pass_through(run: Run) -> None:
    """The output of batch is read again."""
    Path("first.csv").write_text("material,radius [nm],speed [m/s]\nquartz,100,1\n")
    assert run("batch first.csv -o second.csv").code == 0
    again = run("batch second.csv -o third.csv --quantities yield_angle")
    assert "not read" not in again.err


MOST = {"inputs": 0.03, "plain": 0.04, "sphere 2": 0.07}  # the largest fraction of headers that may pass, by group


@pytest.mark.parametrize(("seed", "count"), [(4, 600), pytest.param(5, 12_000, marks=pytest.mark.slow)])
def test_few_headers_that_mean_an_input_pass_through(seed: int, count: int) -> None:
    """No header is misread, few that mean an input pass through, most others do, and little advice is wrong."""
    headers = meant_headers(seed, count)
    outcomes = {header.text: outcome(header) for header in headers}
    assert MISREAD not in outcomes.values()
    groups = groups_of(headers)
    for group, most in MOST.items():
        passed = [each.text for each in groups[group] if outcomes[each.text] == PASSED]
        assert len(passed) <= most * len(groups[group]), (group, passed)
    none = [each.text for each in groups["none"] if outcomes[each.text] in (PASSED, IDLE)]
    assert len(none) > 0.68 * len(groups["none"])
    assert [*outcomes.values()].count(MISLED) <= 0.012 * len(groups["inputs"])


def test_a_header_with_a_factor_or_function_gets_no_advice(run: Run) -> None:
    for head in ("half radius of grain (um)", "2*foo (GPa)", "log E_mat (GPa)"):
        said = ran(run, f"material,{head}", "quartz,3", "--radius 1um")
        assert said.startswith("2: "), head
        assert re.findall(r"--column '[^']*=(\w+)", said) == [], head


def test_properties_of_a_wall_are_those_of_sphere_2(run: Run) -> None:
    Path("x.csv").write_text("radius [um],E [GPa],nu,E wall (GPa),wall poisson ratio\n1,70,0.2,3,0.4\n")
    assert run("batch x.csv --quantities contact_modulus --material2 gold -o out.csv").code == 0
    value = float(Path("out.csv").read_text().splitlines()[1].split(",")[5])
    assert value == approx(1e9 / ((1 - 0.04) / 70 + (1 - 0.16) / 3), rel=1e-12)


MANGLED = {
    "E2 (N/mm?)": "youngs_modulus2",
    "rho_p, kg?m??": "density",
    "dupre_work_dyne_cm_": "work_of_adhesion",
    "W__mJ_m__": "work_of_adhesion",
    "e_0_pj": "energy",
    "grain size [A]": "radius",
    "ENERGIA CINETICA/EV": "energy",
    "r_m / nanometer": "radius",
    "W_of_A / erg/cm2": "work_of_adhesion",
    "v [ms-1]": "speed",
    "interface_energy_mJPerM2": "work_of_adhesion",
    "vdw_hamaker_constant [eV]": "hamaker",
    "Γ [mJ/m2]": "surface_energy",
}


@pytest.mark.parametrize("head", MANGLED)
def test_a_header_with_a_mangled_word_or_unit_is_refused(head: str) -> None:
    """It is neither misread nor passed through. Capitals are changed, signs and powers lost, and Å is written as A."""
    assert outcome(Header(head, MANGLED[head], 1.0, is_plain=False, is_of_2=False)) == REFUSED


@pytest.mark.parametrize("head", ["радиус (um)", "半径_m", "������ [nm]", "нагрузка (nN)", "Ñ€Ð°Ð´Ð¸ÑƒÑ\x81 (nm)"])
def test_the_unit_alone_decides_for_a_word_in_another_script(head: str) -> None:
    assert outcome(Header(head, "radius", 1.0, is_plain=False, is_of_2=False)) == REFUSED


@pytest.mark.parametrize(
    "head",
    ["fx [N]", "fz (nN)", "F [N]", "x (m)", "z [um]", "dx [nm]", "time (s)", "torque_x [N m]", "sp_A", "area (nm2)",
     "current [A]", "viscosity (Pa s)", "100 um", "T (K)", "D (m2/s)"],
)  # fmt: skip
def test_a_column_of_a_simulation_passes_through(head: str) -> None:
    assert outcome(Header(head, "", 1.0, is_plain=False, is_of_2=False)) == PASSED


ADVICE = {
    "nu_w": {"poisson_ratio", "poisson_ratio2"},
    "xi_r (nm)": {"yield_displacement"},
    "d50 [um]": {"diameter"},
    "d_min (nm)": {"diameter", "atomic_spacing"},
    "delta_roll (nm)": {"yield_displacement", "approach_at_load"},
    "dGamma in N/m": {"surface_energy", "work_of_adhesion"},
    "delta_w (mJ/m2)": {"adhesion_hysteresis"},
    "modulo ridotto [GPa]": {"contact_modulus"},
    "Particle density, wall [kg/m3]": {"density2"},
    "elastic modulus of the wall_N_m_2": {"youngs_modulus2"},
    "DMT modulus of the plate, measured (Pa)": {"youngs_modulus2", "contact_modulus"},
    "indenterdiameter_micron": {"diameter", "approach_at_load"},
    "Er__dyne/cm^2": {"contact_modulus"},
    "A_22 [Joule]": {"hamaker2"},
    "R_asp (um)": set(),
    "asperitytipradius(nm)": set(),
}


@pytest.mark.parametrize("head", ADVICE)
def test_advice_names_only_inputs_that_a_header_may_mean(head: str) -> None:
    assert advice_for(head) <= ADVICE[head]
    assert bool(advice_for(head)) == bool(ADVICE[head])


@pytest.mark.parametrize("head", ["P_n {N}", "P_n / N", "P_n-N", "P_n_N", "P_n N"])
def test_the_index_of_a_symbol_is_not_a_prefix_of_its_unit(head: str) -> None:
    """The load P_n is in N, not in nN."""
    assert outcome(Header(head, "load", 1.0, is_plain=False, is_of_2=False)) != MISREAD


@pytest.mark.parametrize("head", ["IMPACT_ENERGY_PJ", "impact energy pj"])
def test_a_prefix_of_unclear_case_is_not_misread(head: str) -> None:
    """The prefix P may be pico or peta."""
    assert outcome(Header(head, "energy", 1e-12, is_plain=False, is_of_2=False)) != MISREAD


def test_the_symbol_of_a_header_is_not_a_prefix_of_its_unit() -> None:
    """The Hamaker constant A is in J, not in aJ."""
    assert outcome(Header("WALL_HAMAKER_A_J", "hamaker2", 1.0, is_plain=False, is_of_2=True)) == REFUSED


# --- Inputs that the table lacks --------------------------------------------------------------------------------------

MAY_BE = "a column that is not read may be one: write --column"


@pytest.mark.parametrize(
    ("heads", "options", "ending"),
    [
        ("d50 (um),gamma [mJ/m2]", "", "'d50 (um)=diameter [um]'"),
        ("Korn (um),material", "", "'Korn (um)=radius [um]' or --column 'Korn (um)=diameter [um]'"),
        ("Size [nm],material", "--pass-rest", "'Size [nm]=radius [nm]' or --column 'Size [nm]=diameter [nm]'"),
        ("radius [nm],SE (mJ/m2)", "",
         "'SE (mJ/m2)=surface_energy [mJ/m2]' or --column 'SE (mJ/m2)=work_of_adhesion [mJ/m2]'"),
        ("radius [nm],interfacial energy [mJ/m2]", "", "'interfacial energy [mJ/m2]=work_of_adhesion [mJ/m2]'"),
    ],
)  # fmt: skip
def test_unread_columns_that_may_be_a_missing_input_are_offered(
    run: Run, heads: str, options: str, ending: str
) -> None:
    cells = ",".join("quartz" if head == "material" else "3" for head in heads.split(","))
    assert f"{MAY_BE} {ending}\n" in ran(run, heads, cells, options)
    said = ran(run, heads, cells, f"{options} --quantities pull_off_force")
    assert said.startswith("2: ")
    assert f"{MAY_BE} {ending}\n" in said
    advised = shlex.split(said[said.index("--column") :].splitlines()[0].partition(" or ")[0])
    assert ran(run, heads, cells, shlex.join([*advised, *options.split(), "--quantities", "pull_off_force"]))[0] == "0"


def test_columns_of_other_lengths_are_not_offered_as_a_radius(run: Run) -> None:
    heads, cells = "contact radius (nm),height (nm),wall d (um),asperity r [nm],id,material", "3,3,3,3,3,quartz"
    assert "needs radius of sphere 1; give a radius such as 100nm\n" in ran(
        run, heads, cells, "--quantities P_c --pass-rest"
    )


@pytest.mark.parametrize("head", ["Spitzenradius [nm]", "Straal [nm]"])
def test_the_first_radius_of_a_table_is_that_of_sphere_1(run: Run, head: str) -> None:
    """The column is not offered as the radius of sphere 2, even if sphere 2 is a plane."""
    said = ran(run, f"{head},material", "30,quartz", "--radius2 plane --quantities pull_off_force")
    assert "radius2" not in said
    assert said.startswith("0: ") or f"{MAY_BE} '{head}=radius [nm]'" in said


def test_a_diameter_that_contradicts_the_radius_is_refused(run: Run) -> None:
    heads, options = "radius [nm],diameter [um],material", "--quantities pull_off_force"
    assert ran(run, heads, "100,0.3,quartz", options) == (
        "2: jkroll: header: 'diameter [um]' (first cell '0.3'): in a row it is 3 times 'radius [nm]', not twice; "
        "to read it, write --column 'radius [nm]='. Write --column 'diameter [um]=' to pass it through\n"
    )
    assert ran(run, heads, "100,0.3,quartz", f"{options} --column 'radius [nm]='").startswith(
        "0: read: material, diameter"
    )
    for cells in ("100,0.2,quartz", "104,0.21,quartz", "100,?,quartz"):
        assert "passed through: diameter [um]" in ran(run, heads, cells, options)
    assert (
        ran(run, "radius [nm],diameter,radius2,diameter2,material", "100,200 nm,plane,plane,quartz", options)[0] == "0"
    )
    assert ran(run, heads, "100,0.3,quartz", f"{options} --pass-rest")[0] == "0"
