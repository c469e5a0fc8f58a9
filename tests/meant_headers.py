"""Headers as people write them: thousands for each seed, each header with its meaning.

    python tests/meant_headers.py 1 2 3

prints for each seed how headers are read next to a column `material`. The words come from papers on dust, decks and
tables of DEM codes, exports of AFM software, data sheets of powders, and lists of materials. They were collected
independently of the program, which does not know some of them. About half of the headers mean a quantity that is not an
input; most of these quantities have the dimension of an input, as a hardness has. The program may refuse their headers
or pass them through, but must never read them as an input.
"""

import re
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from random import Random
from typing import NamedTuple
from unicodedata import normalize

from jkroll.errors import BadTable
from jkroll.materials.library import known_materials
from jkroll.quantities.nomenclature import computed_as
from jkroll.report.questions import BY_DEFAULT
from jkroll.tables.header import Header as Understood
from jkroll.tables.header import understood
from jkroll.tables.table import Asked
from jkroll.tables.unread import Supply
from relative import approx


class Header(NamedTuple):
    """A header with its meaning."""

    text: str
    name: str  # the input that it means; "" if none
    factor: float  # from numbers in the column to the input in SI units
    is_plain: bool  # ASCII as a person types it, with the unit in brackets
    is_of_2: bool  # means sphere 2 only
    others: tuple[str, ...] = ()  # other inputs that it may mean
    share: float = 1.0  # the input over the number in the column: a radius is half of a diameter

    @property
    def advice(self) -> set[str]:
        """The inputs that the program may suggest for the header."""
        names = {self.name, *self.others}
        return {name.replace("radius", "diameter") for name in names} if self.share == 0.5 else names


class Term(NamedTuple):
    """A word or a symbol, with the inputs that it may mean and their SI unit."""

    text: str
    names: tuple[str, ...]
    unit: str
    kind: str = "word"  # or "symbol", or "foreign": a word of another language
    share: float = 1.0  # the input over the quantity of the word: a radius is half of a diameter


# --- Words ------------------------------------------------------------------------------------------------------------

# Words by the inputs that they may mean and the SI unit ("1" for a number). A share follows *.
_WORDS = """
radius m: radius | particle radius | tip radius | sphere radius | grain radius | bead radius | monomer radius | \
tip radius of curvature | radius of curvature | apex radius | end radius | probe radius | colloid radius | \
primary particle radius | half diameter | Rad | indenter radius | ball radius | core radius | nominal radius | radii
radius m *0.5: diameter | particle diameter | size | grain size | particle size | bead diameter | monomer diameter | \
dia | dia. | Sauter mean diameter | median particle size | mean diameter | sphere diameter | tip diameter | \
ball diameter
radius,reduced_radius m: effective radius | equivalent radius | R effective
reduced_radius m: reduced radius | reduced contact radius R* | harmonic radius | combined radius
surface_energy J/m^2: surface energy | surface free energy | free surface energy | solid surface energy | \
surf energy | surface energy density | specific surface energy | surf. energy | total surface energy | SFE
surface_energy,work_of_adhesion J/m^2: interface energy | interfacial energy | adhesion energy | adhesive energy | \
surf adh | adhesion energy density | JKR surface energy | JKR adhesion energy | energy of adhesion | \
surface tension | cohesion energy | JKR energy | surface adhesion energy | adhesion
work_of_adhesion J/m^2: work of adhesion | adhesion work | thermodynamic work of adhesion | Dupre work | \
Dupre energy | specific work of adhesion | work of separation | adhesion work per area | strain energy release rate | \
fracture energy | critical energy release rate | work of cohesion | JKR work of adhesion | DMT work of adhesion
youngs_modulus Pa: Young's modulus | youngs modulus | Young modulus | elastic modulus | modulus of elasticity | \
elasticity modulus | tensile modulus | Young | Youngs | elastic stiffness modulus | YM | E modulus | Ymod | \
Young's mod. | elasticity | material stiffness | Young's Modulus E | particle stiffness
youngs_modulus,contact_modulus Pa: modulus | DMT modulus | indentation modulus | contact stiffness modulus | \
JKR modulus | Hertz modulus | Sneddon modulus | Oliver-Pharr modulus | Derjaguin modulus | fit modulus | \
EModulus | indentation E | nanoindentation modulus | plane strain modulus
contact_modulus Pa: reduced modulus | effective modulus | reduced Young's modulus | effective Young's modulus | \
contact modulus | equivalent modulus | combined modulus | effective elastic modulus | composite modulus | \
reduced elastic modulus | E star
poisson_ratio 1: Poisson's ratio | Poisson ratio | poisson | Poissons ratio | Poisson | Poisson coefficient | \
Poisson number | lateral strain ratio | PR
density kg/m^3: density | mass density | material density | particle density | true density | solid density | \
skeletal density | grain density | specific mass | intrinsic density | pycnometric density | helium density | dens | \
monomer density | volumetric mass | solids density | crystal density
hamaker J: Hamaker constant | Hamaker | Hamaker coefficient | Hamaker const. | vdW Hamaker constant | \
non-retarded Hamaker constant | Hamaker A | A Hamaker
yield_displacement m: critical rolling displacement | rolling displacement | critical displacement | \
critical rolling distance | yield displacement | rolling yield displacement | critical slip of rolling | xi crit | \
critical rolling shift | inelastic rolling displacement | critical roll displacement
load N: load | applied load | normal load | normal force | applied force | preload | setpoint | setpoint force | \
trigger force | contact load | compressive load | external load | pressing force | static load | pre load | \
set point force | deflection setpoint force | loading force | normal contact force | indentation load
gravity m/s^2: gravity | gravitational acceleration | acceleration of gravity | g level | surface gravity | \
acceleration due to gravity | local gravity | grav
energy J: impact energy | collision energy | kinetic energy | energy of impact | incident energy | incoming energy | \
collisional energy | initial kinetic energy | impact kinetic energy | kin. energy | KE | particle kinetic energy
speed m/s: speed | velocity | impact velocity | impact speed | collision velocity | collision speed | \
relative velocity | relative speed | initial velocity | incident velocity | particle velocity | projectile velocity | \
launch velocity | normal impact velocity | collisional velocity | encounter velocity | impact vel | vel | vel. | \
approach velocity
approach_at_load m: approach | indentation | overlap | penetration | indentation depth | normal overlap | \
penetration depth | mutual approach | particle overlap | contact deformation | interpenetration
adhesion_hysteresis J/m^2: adhesion hysteresis | hysteresis of adhesion | adhesive hysteresis | \
contact hysteresis energy
hysteresis_fraction 1: hysteresis fraction | relative adhesion hysteresis | adhesion hysteresis fraction
atomic_spacing m: atomic spacing | interatomic spacing | interatomic distance | equilibrium separation | \
equilibrium distance | atomic distance | range of attraction | equilibrium spacing | range of adhesion
cutoff m: cutoff | cutoff distance | cut-off distance | vdW cutoff | van der Waals cutoff | contact cutoff
atomic_spacing,cutoff m: minimum separation | minimum distance | closest distance | minimum separation distance
viscous_time s: viscous time | viscous damping time | viscous dissipation time | viscoelastic time
asperity_radius m: asperity radius | asperity tip radius | radius of asperities | asperity radius of curvature | \
roughness asperity radius | surface asperity radius
yield_strength Pa: yield strength | yield strength of the solid
shear_strength Pa: shear strength | interfacial shear strength | contact shear strength | interface shear strength
monomers 1: monomers | number of monomers | monomer number | n monomers | monomer count | num monomers
contacts 1: number of contacts | n contacts | contacts | contact number | num contacts
filling_factor 1: filling factor | volume filling factor | packing fraction | solid fraction
rolling_angle rad: rolling angle | roll angle | angle of rolling
humidity 1: humidity | relative humidity
contact_angle rad: contact angle | water contact angle
"""

_SYMBOLS = """
radius m: R1 | R_1 | r_p | R_p | Rp | R_tip | Rtip | r_tip | R_s | a_p | a_mon | r_mon | r_m | r0 | R_0 | r_grain | \
a0 | rp
radius,reduced_radius m: R | r
radius2 m: R2 | r2 | R_2 | R₂ | Rj | R_j
radius m *0.5: d | D | d_p | Dp | d50 | D50 | d32 | dp | Ø | D_p | 2R | D_tip | d_mon | D[4,3]
reduced_radius m: R* | R_eff | Reff | R_red | R_ij | Rstar | R_star | r_eff
surface_energy J/m^2: gamma | γ | Gamma | GAMMA | γ_s | gamma_s | γ1 | gamma1 | gamma_1 | gam | γ_SV | gamma_sv | \
γS | sigma_s | Γ_s
surface_energy2 J/m^2: gamma2 | γ2 | γ₂ | gamma_2 | gamma_j
surface_energy,work_of_adhesion J/m^2: Γ | E_adh | E_surf | w_surf | G_adh
work_of_adhesion J/m^2: w | W | W_adh | W_ad | Wad | w_12 | W12 | W_132 | ΔΓ | Δγ | delta_gamma | Gc | G_c | G_Ic | \
w_a | W_a | Wadh | wadh | W_A | 2γ | 2gamma | W_JKR | W_DMT
youngs_modulus Pa: E | Y | E1 | E_1 | E_s | Es | E_p | Ep | E_i | E_tip | E_sample | Y_p | Emod | E_mod | E_Y | EY | \
E_Young | E_part | Young_E | E_grain | E11
youngs_modulus2 Pa: E2 | E_2 | E₂ | E_j | Y2 | E_w | Ew | E_wall | E_sub | E_target
contact_modulus Pa: E* | Er | E_r | Eeff | E_eff | Estar | E_star | E_red | E_eq | Y_eff | E*_eff
poisson_ratio 1: nu | ν | Nu | nu1 | ν1 | ν_s | nu_s | nu_p | ν_p | v_poisson | poiss
poisson_ratio2 1: nu2 | ν2 | ν₂ | nu_2 | nu_w
density kg/m^3: rho | ρ | Rho | RHO | rho_p | ρ_p | rho_s | ρ_s | rho1 | ρ1 | rhop | rho_m | ρ_m | rho_mat | rho_0 | \
ρp
density2 kg/m^3: rho2 | ρ2 | ρ₂ | rho_2 | rho_j
hamaker J: A | A_H | AH | A_Ham | A11 | A_11 | A_hamaker | A_131 | Aham | C_H
hamaker2 J: A2 | A_22 | A22
yield_displacement m: xi | ξ | xi_crit | ξ_crit | xi_c | ξ_c | ξcrit | ksi | Xi | x_crit | xicrit | xi_r | ξ_0 | \
xi_roll | delta_roll
load N: P | F_n | Fn | FN | F_N | F_load | L | Pn | F_app | F_applied | P_load | F_ext | Fz_load | F_set | F_pre
gravity m/s^2: g | g0 | g_eff | gz
energy J: E_kin | Ekin | E_k | E_coll | E_imp | W0 | K.E. | E_kin0 | E_i | Eimp | U_kin | E_0
speed m/s: v | v_imp | vimp | v_rel | V | v_0 | v0 | vrel | v_coll | v_in | Vi | V_imp | v_i | v_n | u_imp | dv | \
Δv | U_rel
approach_at_load m: delta | δ | δ_n | delta_n | deltan | h_ind | d_ind
adhesion_hysteresis J/m^2: Δw | delta_w | Δw_hyst
atomic_spacing m: z0 | z_0 | Z0 | z₀ | eps_0 | h0
atomic_spacing,cutoff m: D0 | D_0 | d_min | h_min
cutoff m: D_cut | r_cut_vdw
viscous_time s: T_vis | tau_vis | t_vis
asperity_radius m: r_asp | R_asp | Rasp
yield_strength Pa: S_y | Sy
shear_strength Pa: tau | τ | tau0 | τ_0 | tau_s | τs
monomers 1: N_mon | n_monomers | Nmono
filling_factor 1: phi_fill | VFF
"""

_FOREIGN = """
radius m: Partikelradius | Kugelradius | Spitzenradius | Kornradius | Teilchenradius | rayon | \
rayon de la particule | rayon de pointe | rayon du grain | radio | radio de la partícula | raggio | rayon moyen | \
raio | straal | 半径 | радиус
radius m *0.5: Durchmesser | Partikeldurchmesser | diamètre | diámetro | Korngröße | taille des grains | \
Partikelgröße
reduced_radius m: reduzierter Radius | rayon réduit | radio reducido | effektiver Radius | rayon effectif
surface_energy J/m^2: Oberflächenenergie | freie Oberflächenenergie | Oberflaechenenergie | énergie de surface | \
energie de surface | energía superficial | energia superficial | spezifische Oberflächenenergie | 表面能
surface_energy,work_of_adhesion J/m^2: Grenzflächenenergie | Haftenergie | énergie d'adhésion | Adhäsionsenergie
work_of_adhesion J/m^2: Adhäsionsarbeit | Haftarbeit | travail d'adhésion | trabajo de adhesión | Adhaesionsarbeit
youngs_modulus Pa: Elastizitätsmodul | E-Modul | Elastizitaetsmodul | module d'Young | module de Young | \
module d'élasticité | módulo de Young | modulo de Young | módulo de elasticidad | Youngscher Modul | EModul | 杨氏模量
contact_modulus Pa: reduzierter Modul | module réduit | módulo reducido | reduzierter E-Modul | effektiver E-Modul
poisson_ratio 1: Poissonzahl | Querkontraktionszahl | Querdehnzahl | Poisson-Zahl | coefficient de Poisson | \
coeficiente de Poisson | Poissonverhältnis | 泊松比
density kg/m^3: Dichte | Partikeldichte | Materialdichte | Feststoffdichte | Reindichte | densité | masse volumique | \
densidad | densità | Massendichte | Rohdichte | densidade | 密度 | плотность
hamaker J: Hamaker-Konstante | Hamakerkonstante | constante de Hamaker
yield_displacement m: kritische Rollverschiebung | déplacement critique de roulement | kritische Verschiebung
load N: Last | Normalkraft | Auflast | Belastung | charge normale | force normale | carga | carga normal | \
charge appliquée
gravity m/s^2: Erdbeschleunigung | Fallbeschleunigung | Schwerebeschleunigung | pesanteur | gravedad
energy J: kinetische Energie | Stoßenergie | énergie cinétique | energía cinética | énergie d'impact | \
Aufprallenergie
speed m/s: Geschwindigkeit | Aufprallgeschwindigkeit | Stoßgeschwindigkeit | Relativgeschwindigkeit | vitesse | \
vitesse d'impact | velocidad | velocidad de impacto | Kollisionsgeschwindigkeit | vitesse relative | 速度
approach_at_load m: Eindringtiefe | Indentationstiefe | enfoncement | Überlappung | interpénétration | indentación
atomic_spacing m: Atomabstand | distance interatomique | Gleichgewichtsabstand
shear_strength Pa: Scherfestigkeit | résistance au cisaillement
"""

# Words that mean no input, by unit; but a shear modulus is an input, see `outcome`.
_NONE = """
N/m: stiffness | spring constant | k_n | kn | k_t | cantilever stiffness | Federkonstante | raideur | k | \
cantilever spring constant | normal stiffness | contact stiffness | tangential stiffness | k_lever | kt | \
bond stiffness
J/m^2: liquid surface tension | surface tension of water | gamma_LV | γ_LV | γ_L | polar component | gamma_d | γ_d | \
dispersive component | γ_p polar | laser fluence | impact strength | stacking fault energy | grain boundary energy | \
interfacial tension oil/water | dose | Charpy impact | meniscus surface tension | water surface tension | γ_l | \
Oberflächenspannung Wasser | tension superficielle du liquide
Pa: hardness | Härte | dureté | yield stress | tensile strength | pressure | P | p | sigma | σ | \
shear modulus | bulk modulus | G | K | storage modulus | loss modulus | sigma_y | stress | compressive strength | \
UTS | fracture stress | H | HV | Streckgrenze | contact pressure | max pressure | Druck | pression | sigma_xx | \
flexural strength | flow stress | G' | G'' | cohesion c | vapor pressure | Laplace pressure | von Mises stress | \
σ_y | consolidation stress | tau_yield | elastic limit | p0 | indentation hardness | Vickers | shear stress | \
Zugfestigkeit | limite d'élasticité
m: x | y | z | X position | z position | distance | box length | wavelength | thickness | film thickness | Rq | Ra | \
Rz | roughness | rms roughness | Sa | contact radius | a | displacement | gap | separation | height | depth | Sq | \
lattice constant | mean free path | step size | scan size | deflection | piezo displacement | cantilever length | \
pore radius | radius of gyration | Bohr radius | Debye length | capillary length | orbital radius | beam waist | λ | \
bend radius | nozzle radius | wire diameter | tube diameter | pore size | zpos | x_pos | sensor height | width | \
length | Rauheit | longueur d'onde | Schichtdicke | épaisseur | Abstand | pit diameter | crater diameter | \
jump-in distance | snap-in distance | mesh size | skin | dx | oxide thickness | peak distance | Z sensor | \
contact diameter | tip height | slip distance | tip-sample separation | rupture length | tip-sample distance | \
coating thickness | crack length
N: adhesion force | pull-off force | F_ad | F_adh | friction force | drag force | weight | capillary force | \
max force | Haftkraft | snap-in force | force noise | F | Fad | Adhäsionskraft | pull off force | lateral force | \
F_pulloff | force | jump-off force | peak force error | force d'adhésion | Reibkraft | breaking force | F_c | \
detachment force | adhesive force | buoyancy | F_lat | F_drag | fuerza de adhesión | rupture force | F_max | \
peeling force
J: kB T | kBT | thermal energy | activation energy | potential energy | binding energy | latent heat | \
dissipated energy | band gap | ionization energy | work function | E_bind | total energy | E_pot | \
chemical potential | dissipation | bond energy | E_b | E_roll | rolling energy | breaking energy | E_break | \
surface binding energy | well depth | epsilon | Aktivierungsenergie | énergie potentielle | photon energy | \
Fermi energy | heat | lost energy
m/s: vx | vy | v_x | sound speed | speed of sound | terminal velocity | sticking velocity | rebound velocity | \
scan speed | wind speed | flow velocity | u | friction velocity | threshold velocity | gas velocity | v_stick | \
v_frag | c_s | drift | fragmentation velocity | v_rebound | settling velocity | Schallgeschwindigkeit | \
vitesse du son | z velocity | escape velocity | thermal velocity | bouncing velocity | v_esc | p-wave velocity | \
shear wave speed | v_reb | orbital speed
kg/m^3: bulk density | tapped density | fluid density | gas density | air density | packing density | concentration | \
mass concentration | rho_f | rho_g | ρ_g | ρ_f | rho_gas | rho_bulk | Schüttdichte | tap density | water density | \
liquid density | densité apparente | apparent bulk density | rho_air | medium density | ρ_b
m/s^2: vibration acceleration | a_max | radiation acceleration | ax | shaker acceleration | peak acceleration
s: time | dt | contact time | relaxation time | period | t | Zeit | dwell time | time step | temps | duration | tau | \
t_c
rad: phase | tilt angle | latitude | friction angle | angle of repose | phi | ψ
K: T | temperature | Temperatur | Tg | melting point | ambient temperature
kg: mass | m | particle mass | sample mass | Masse
1: restitution coefficient | friction coefficient | porosity | void fraction | sphericity | strain | aspect ratio | \
mu | coefficient of restitution | mu_r | cor | e_n | roundness | coordination number | R2 fit | R-squared
Hz: frequency | f0 | resonance frequency | sampling rate
Pa s: viscosity | eta | dynamic viscosity | Viskosität
m^2: area | contact area | cross section | grain area
m^2/s: nu | kinematic viscosity | diffusivity
"""

_UNITS: Mapping[str, list[tuple[str, float]]] = {
    "m": [("nm", 1e-9), ("nm", 1e-9), ("um", 1e-6), ("µm", 1e-6), ("μm", 1e-6), ("mum", 1e-6), ("micron", 1e-6),
          ("microns", 1e-6), ("Å", 1e-10), ("angstrom", 1e-10), ("mm", 1e-3), ("m", 1.0), ("pm", 1e-12), ("cm", 1e-2),
          ("nanometer", 1e-9), ("micrometer", 1e-6), ("A", 1e-10), ("Angstroms", 1e-10)],
    "J/m^2": [("mJ/m2", 1e-3), ("J/m^2", 1.0), ("J/m2", 1.0), ("mJ/m²", 1e-3), ("J m-2", 1.0), ("mJ m^-2", 1e-3),
              ("mJ.m-2", 1e-3), ("N/m", 1.0), ("mN/m", 1e-3), ("dyn/cm", 1e-3), ("erg/cm2", 1e-3), ("erg/cm^2", 1e-3),
              ("J·m⁻²", 1.0), ("mJ m⁻²", 1e-3), ("erg cm-2", 1e-3), ("J/m**2", 1.0), ("mJ/sq.m", 1e-3),
              ("dyne/cm", 1e-3), ("mJ per m2", 1e-3)],
    "Pa": [("GPa", 1e9), ("GPa", 1e9), ("MPa", 1e6), ("Pa", 1.0), ("kPa", 1e3), ("kN/mm2", 1e9), ("N/m2", 1.0),
           ("N/m^2", 1.0), ("N/mm²", 1e6), ("dyn/cm2", 0.1), ("dyne/cm^2", 0.1), ("N/mm2", 1e6), ("GN/m2", 1e9),
           ("psi", 6894.757293168361), ("Gpa", 1e9), ("gigapascal", 1e9)],
    "kg/m^3": [("kg/m3", 1.0), ("kg/m^3", 1.0), ("g/cm3", 1e3), ("g/cm^3", 1e3), ("g/cc", 1e3), ("g/mL", 1e3),
               ("g/ml", 1e3), ("kg/m³", 1.0), ("g/cm³", 1e3), ("kg m-3", 1.0), ("kg m^-3", 1.0), ("g cm-3", 1e3),
               ("kg·m⁻³", 1.0), ("kg/dm3", 1e3), ("g.cm-3", 1e3), ("kg/cu.m", 1.0), ("kg/l", 1e3)],
    "J": [("J", 1.0), ("zJ", 1e-21), ("aJ", 1e-18), ("eV", 1.602176634e-19), ("fJ", 1e-15), ("erg", 1e-7),
          ("pJ", 1e-12), ("nJ", 1e-9), ("10^-20 J", 1e-20), ("1e-20 J", 1e-20), ("Joule", 1.0),
          ("keV", 1.602176634e-16)],
    "N": [("nN", 1e-9), ("nN", 1e-9), ("N", 1.0), ("uN", 1e-6), ("µN", 1e-6), ("mN", 1e-3), ("pN", 1e-12),
          ("μN", 1e-6), ("dyn", 1e-5), ("nano-N", 1e-9), ("nanonewton", 1e-9)],
    "m/s": [("m/s", 1.0), ("m/s", 1.0), ("cm/s", 1e-2), ("mm/s", 1e-3), ("m s-1", 1.0), ("m.s-1", 1.0),
            ("m s^-1", 1.0), ("km/s", 1e3), ("m·s⁻¹", 1.0), ("µm/s", 1e-6), ("um/s", 1e-6), ("m/sec", 1.0),
            ("cm s⁻¹", 1e-2), ("mps", 1.0)],
    "m/s^2": [("m/s2", 1.0), ("m/s^2", 1.0), ("m/s²", 1.0), ("m s-2", 1.0), ("cm/s2", 1e-2), ("m·s⁻²", 1.0)],
    "s": [("s", 1.0), ("ps", 1e-12), ("ns", 1e-9), ("us", 1e-6), ("µs", 1e-6), ("sec", 1.0), ("ms", 1e-3)],
    "rad": [("rad", 1.0), ("deg", 0.017453292519943295), ("°", 0.017453292519943295),
            ("degrees", 0.017453292519943295)],
    "1": [("", 1.0), ("-", 1.0), ("1", 1.0), ("", 1.0), ("", 1.0)],
    "N/m": [("N/m", 1.0), ("mN/m", 1e-3), ("nN/nm", 1.0), ("N m-1", 1.0), ("kN/m", 1e3), ("pN/nm", 1e-3)],
    "K": [("K", 1.0), ("°C", 1.0), ("C", 1.0)],
    "kg": [("kg", 1.0), ("g", 1e-3), ("mg", 1e-6), ("pg", 1e-15)],
    "Hz": [("Hz", 1.0), ("kHz", 1e3), ("MHz", 1e6)],
    "Pa s": [("Pa s", 1.0), ("Pa.s", 1.0), ("mPa s", 1e-3), ("cP", 1e-3), ("Pa·s", 1.0)],
    "m^2": [("nm2", 1e-18), ("um^2", 1e-12), ("µm²", 1e-12), ("m2", 1.0)],
    "m^2/s": [("m2/s", 1.0), ("cm^2/s", 1e-4), ("cSt", 1e-6)],
}  # fmt: skip

_OF_1_OR_2 = (
    "tip probe particle sample sphere grain bead monomer projectile colloid intruder indenter powder ball".split()
)
_OF_2 = "substrate wall target plate counterbody plane boundary geometry".split()
# The sphere that each index means; "" if it may be either sphere.
_INDEX_OF = {"p": "", "s": "", "t": "", "i": "", "1": "1", "2": "2", "j": "2", "w": "2", "B": "2", "sub": "2", "A": "1"}
# Excluded indices: those with another meaning (polar, of water), and those of bodies without a radius.
_NOT_OF: Mapping[str, Sequence[str]] = {"surface_energy": "pstAw", "density": "w", "radius": ("w", "sub", "A", "B")}
_WITH_BODY = ("youngs_modulus", "poisson_ratio", "density", "surface_energy", "hamaker", "radius")
_OF_BODIES = ("{b} {w}", "{b} {w}", "{w} {b}", "{w} of {b}", "{w} of the {b}", "{w} ({b})", "{w}, {b}", "{w} - {b}")
_SYMBOL_OF_BODIES = ("{w}_{b}", "{w} {b}", "{b} {w}", "{w}{B}", "{w}({b})", "{w},{b}", "{w}_{{{b}}}", "{b}_{w}")
_OF_INDICES = ("{w}{i}", "{w} {i}", "{w}_{i}", "{w} ({i})", "{w} sphere {i}", "{w} of particle {i}", "{w} body {i}",
    "{o} {w}", "particle {i} {w}", "{w} of sphere {i}", "material {i} {w}", "sphere{i} {w}", "{w} #{i}")  # fmt: skip
_SYMBOL_OF_INDICES = ("{w}_{i}", "{w}{i}", "{w} {i}", "{w}_{{{i}}}", "{w}({i})", "{w}_sphere{i}")
# Words that headers add to the name of a quantity.
_ADDED = ("mean", "average", "measured", "nominal", "avg.", "typical", "assumed", "input", "literature", "true")


def _terms() -> Iterator[Term]:
    """Iterate over all words and symbols of inputs."""
    for kind, text in (("word", _WORDS), ("symbol", _SYMBOLS), ("foreign", _FOREIGN)):
        for line in text.strip().splitlines():
            head, _, words = line.partition(": ")
            names, unit, *share = head.split(" ")
            factor = float(share[0][1:]) if share else 1.0
            yield from (Term(word.strip(), tuple(names.split(",")), unit, kind, factor) for word in words.split(" | "))


def _terms_of_none() -> Iterator[Term]:
    """Iterate over the words and symbols of other quantities."""
    for line in _NONE.strip().splitlines():
        unit, _, words = line.partition(": ")
        for word in words.split(" | "):
            yield Term(word.strip(), (), unit, "word" if " " in word.strip() else "symbol")


# --- Spellings --------------------------------------------------------------------------------------------------------


def _camel(text: str) -> str:
    first, *others = re.split(r"[\s_-]+", text)
    return first + "".join(map(_capitalized, others))


def _capitalized(text: str) -> str:
    return text[:1].upper() + text[1:]


_CASES: Mapping[str, Callable[[str], str]] = {
    "as it is": str,
    "small": str.lower,
    "title": lambda text: " ".join(map(_capitalized, text.split(" "))),
    "first": _capitalized,
    "capital": str.upper,
    "snake": lambda text: re.sub(r"[\s-]+", "_", text.replace("'", "").lower()),
    "title snake": lambda text: "_".join(map(_capitalized, text.replace("'", "").split())),
    "capital snake": lambda text: re.sub(r"[\s-]+", "_", text.upper()),
    "kebab": lambda text: re.sub(r"\s+", "-", text.lower()),
    "camel": lambda text: _camel(text.replace("'", "").lower()),
    "pascal": lambda text: _capitalized(_camel(text.replace("'", ""))),
    "joined": lambda text: re.sub(r"[\s'-]+", "", text.lower()),
    "dots": lambda text: text.replace(" ", "."),
}  # fmt: skip
_NOTATIONS = ("{w} [{u}]", "{w} ({u})", "{w} [{u}]", "{w} ({u})", "{w} [{u}]", "{w} ({u})", "{w}[{u}]", "{w}({u})",
    "{w} {{{u}}}", "{w} <{u}>", "{w} / {u}", "{w}/{u}", "{w}, {u}", "{w}_{u}", "{w}_{u}", "{w} {u}", "{w} in {u}",
    "{w}_in_{u}", "{w} - {u}", "{w}: {u}", "{w} | {u}", "{w};{u}", "{w}.{u}", "{w}-{u}", "{w} (in {u})", "{w}_[{u}]",
    "{w}_({u})", "{w}  [{u}]", "{w}__{u}", "{w} / ({u})", "{w}\n({u})", "{w} ( {u} )", "{w} [ {u} ]")  # fmt: skip
_PLAIN = ("{w} [{u}]", "{w} ({u})", "{w}[{u}]", "{w}({u})")


_GREEK = {
    "γ": "gamma",
    "ξ": "xi",
    "ρ": "rho",
    "ν": "nu",
    "δ": "delta",
    "τ": "tau",
    "Γ": "Gamma",
    "Δ": "Delta",
    "σ": "sigma",
}
_ANY_GREEK = f"[{''.join(_GREEK)}]"


def _ascii(text: str) -> str:
    """Return a text with Greek letters spelt out and without accents; other alphabets are kept."""
    spelt = re.sub(_ANY_GREEK, lambda found: _GREEK[found[0]], text)
    return (
        re.sub(r"[\u0300-\u036f]", "", normalize("NFKD", re.sub("[µμ]", "u", spelt)))
        .replace("ß", "ss")
        .replace("−", "-")
    )


def _by_janitor(text: str) -> str:
    """Return a text as the R package janitor cleans a header."""
    parted = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", _ascii(text).replace("'", ""))
    return re.sub(r"[^a-z0-9]+", "_", parted.lower()).strip("_")


def _mistaken(text: str) -> str:
    """Return a text in UTF-8 as shown by a program that decodes it as cp1252, like a browser."""
    pieces = (bytes([code]) for code in text.encode())
    return "".join(piece.decode("latin-1" if piece in b"\x81\x8d\x8f\x90\x9d" else "cp1252") for piece in pieces)


_MANGLINGS: Mapping[str, Callable[[str], str]] = {
    "R": lambda text: re.sub(r"[^\w.]", ".", text),
    "MATLAB": lambda text: re.sub(r"[^A-Za-z0-9_]", "_", text),
    "MATLAB, joined": lambda text: re.sub(r"[^A-Za-z0-9_]", "_", _camel(text.replace("-", "_"))),
    "janitor": _by_janitor,
    "SQL, small": lambda text: re.sub(r"[^a-z0-9]+", "_", _ascii(text).lower()).strip("_"),
    "SQL, capital": lambda text: re.sub(r"[^A-Z0-9]+", "_", _ascii(text).upper()).strip("_"),
    "small": str.lower,
    "mistaken": _mistaken,
    "mistaken as Latin-1": lambda text: text.encode().decode("latin-1"),
    "LaTeX": lambda text: re.sub(_ANY_GREEK, lambda found: f"$\\{_GREEK[found[0]]}$", text),
    "HTML": lambda text: re.sub(_ANY_GREEK, lambda found: f"&{_GREEK[found[0]]};", text),
    "lost": lambda text: text.encode("ascii", "replace").decode(),
    "decomposed": lambda text: normalize("NFD", text),
    "quoted": lambda text: f'"{text}"',
    "padded": lambda text: f" {text} ",
    "joined": lambda text: text.replace(" ", ""),
    "underlined": lambda text: text.replace(" ", "_"),
}
# The manglings of headers with letters outside ASCII, and of headers that can be written in ASCII.
_OF_GREEK = ("mistaken", "mistaken", "mistaken as Latin-1", "LaTeX", "HTML", "lost", "decomposed")
_OF_ALL = ("R", "MATLAB", "MATLAB, joined", "janitor", "SQL, small", "SQL, capital", "small", "quoted", "padded",
    "joined", "underlined")  # fmt: skip


def _with_body(term: Term, chance: Random) -> tuple[str, tuple[str, ...], bool]:
    """Return a word, possibly with a body or an index, its meanings, and whether it means sphere 2 only."""
    text = term.text
    if not term.names:
        return text, (), False
    name = term.names[0]
    twin = f"{name}2"
    if name.endswith("2"):
        return text, term.names, True
    is_of_body = name in _WITH_BODY and len(term.names) == 1 and term.kind != "foreign"
    if not is_of_body or any(letter in text for letter in "_12*") or chance.random() < 0.4:
        return text, term.names, False
    is_symbol = term.kind == "symbol"
    if chance.random() < 0.5:
        body = chance.choice(_OF_1_OR_2 if name == "radius" or chance.random() < 0.6 else _OF_2)
        if body in text.lower() or (len(text) > 2 and is_symbol and text[-1] in "ps"):
            return text, term.names, False
        written = chance.choice(_SYMBOL_OF_BODIES if is_symbol else _OF_BODIES).format(w=text, b=body, B=body.title())
        return written, (twin,) if body in _OF_2 else (name, twin), body in _OF_2
    index = chance.choice([*_INDEX_OF] if is_symbol else ["1", "2", "2"])
    if index in _NOT_OF.get(name, ()):
        index = "2"
    written = chance.choice(_SYMBOL_OF_INDICES if is_symbol else _OF_INDICES).format(
        w=text, i=index, o={"1": "first", "2": "second"}.get(index, "")
    )
    sphere = _INDEX_OF[index]
    names = {"": (name, twin), "1": (name,), "2": (twin,)}[sphere]
    return written, names, sphere == "2"


def _header(term: Term, chance: Random) -> Header:
    """Return a header with a word, in a random spelling."""
    text, names, is_of_2 = _with_body(term, chance)
    if term.kind == "word" and names and chance.random() < 0.1:
        text = chance.choice(("{b} {w}", "{b} {w}", "{w} ({b})", "{w}, {b}")).format(b=chance.choice(_ADDED), w=text)
    if term.kind != "symbol":
        text = _CASES[chance.choice(["as it is", "title", "first", *_CASES])](text)
    unit, factor = chance.choice(_UNITS[term.unit])
    notation = chance.choice(_NOTATIONS) if unit else "{w}"
    whole = notation.format(w=text, u=unit)
    is_plain = whole.isascii() and notation in _PLAIN
    how = chance.choice(_OF_ALL) if _ascii(whole).isascii() and chance.random() < 0.2 else ""
    if not how and not whole.isascii() and chance.random() < 0.4:
        how = chance.choice(_OF_GREEK)
        how = "decomposed" if how == "lost" and not text.isascii() else how
    mangled = _MANGLINGS[how](whole) if how else whole
    in_metres = re.search("[µμ]", whole) and re.search(r"[^\W_][_.]m$", mangled)  # everyone reads radius_m as metres
    has_other_meaning = in_metres or ("*" in text and "*" not in mangled)  # without its star, E* is E
    whole = whole if has_other_meaning else mangled
    name, *others = names or ("",)
    return Header(whole, name, factor * term.share, is_plain and not how, is_of_2, tuple(others), term.share)


def meant_headers(seed: int, count: int = 12_000) -> list[Header]:
    """Return distinct headers, about half of them for an input; the same for the same seed."""
    chance, found = Random(seed), dict[str, Header]()
    groups: dict[tuple[str, ...], list[Term]] = {}
    for term in _terms():
        groups.setdefault(term.names, []).append(term)
    inputs, others = [*groups.values()], [*_terms_of_none()]
    weights = [len(group) for group in inputs]
    while len(found) < count:
        group = chance.choices(inputs, weights)[0] if chance.random() < 0.5 else others
        header = _header(chance.choice(group), chance)
        if header.text.strip() and header.text not in found:
            found[header.text] = header
    return [*found.values()]


# --- Outcomes ---------------------------------------------------------------------------------------------------------

READ, MISREAD, REFUSED, PASSED = "read", "misread", "refused", "passed"
MISLED = "refused, and the advice names other inputs alone"
IDLE = "passed, and no other number stands in"
_ASKED = Asked({"radius": "1 um"}, known_materials(), offered=BY_DEFAULT)


@cache
def _supply(columns: frozenset[str]) -> Supply:
    return _ASKED.supply(columns)


def _understood(text: str) -> Understood:
    """Return the columns of a table with a header next to a column of materials, with the radius as an option."""
    return understood(
        ("material", text),
        [["quartz", "0.3"]],
        given=_ASKED.inputs,
        supply_of=lambda columns: _supply(frozenset(columns)),
    )


def advice_for(text: str) -> set[str]:
    """Return the inputs that the refusal of a header suggests; none if the header is not refused."""
    try:
        _understood(text)
    except BadTable as error:
        return advised(str(error))
    return set()


def outcome(header: Header) -> str:
    """Return the outcome of a header next to a column of materials, with the radius as an option."""
    try:
        found = _understood(header.text)
    except BadTable as error:
        meanings = advised(str(error))
        return MISLED if meanings and header.name and meanings.isdisjoint(header.advice) else REFUSED
    if not found.inputs:
        supplied = _supply(frozenset({"material"})).clauses
        return IDLE if header.name and supplied.keys().isdisjoint({header.name, *header.others}) else PASSED
    (column,) = found.inputs
    if not header.name and column.name.startswith("shear_modulus"):
        return PASSED  # an input, although its words are in _NONE
    is_meant = computed_as(column.name) in {header.name, *header.others} - {""}
    factor = 0.5 if column.name.startswith("diameter") else 1.0
    if column.unit is not None:
        numerator, denominator, _ = column.unit
        factor *= numerator / denominator
    is_right = is_meant and factor == approx(header.factor, rel=1e-9)
    return READ if is_right else MISREAD


def advised(message: str) -> set[str]:
    """Return the inputs that a message suggests for a column."""
    columns = re.findall(r"--column '(?:[^']*)=(\w+)|--column \"(?:[^\"]*)=(\w+)", message)
    names = {*map("".join, columns)}
    for alternatives in re.findall(r"a column (.*?) instead of", message):
        names.update(re.findall(r"[a-z]\w+", alternatives))
    return names - {"or"}


def counts(headers: Iterable[Header]) -> Counter[str]:
    """Return the number of headers with each outcome."""
    return Counter(map(outcome, headers))


def groups_of(headers: Sequence[Header]) -> dict[str, list[Header]]:
    """Return headers in groups: of inputs, with the plain ones and those of sphere 2; of none, with the plain ones."""
    inputs = [header for header in headers if header.name]
    return {
        "inputs": inputs,
        "plain": [header for header in inputs if header.is_plain],
        "sphere 2": [header for header in inputs if header.is_of_2],
        "none": [header for header in headers if not header.name],
        "plain none": [header for header in headers if not header.name and header.is_plain],
    }


def main(seeds: Iterable[int]) -> None:
    """Print the outcomes for some seeds, and the headers that are misread."""
    columns = {"read": READ, "misread": MISREAD, "refused": REFUSED, "misled": MISLED, "passed": PASSED, "idle": IDLE}
    print(f"{'seed':>4}  {'headers':10} {'all':>6}", *(f"{head:>8}" for head in columns))
    for seed in seeds:
        headers = meant_headers(seed)
        for group, members in groups_of(headers).items():
            found = counts(members)
            print(f"{seed:>4}  {group:10} {len(members):>6}", *(f"{found[each]:>8}" for each in columns.values()))
        for header in headers:
            if outcome(header) == MISREAD:
                print(f"      misread: {header.text!r} means {header.name or 'no input'} {header.factor:g}")


if __name__ == "__main__":
    main(map(int, sys.argv[1:] or ["1"]))
