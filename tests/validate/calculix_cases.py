# SPDX-License-Identifier: GPL-3.0-or-later
"""The decks of calculix_decks.py: what each shows, its tolerance, and why others are refused."""

PRINTED = 6e-7  # seven digits are printed

ROUNDED = 2e-5  # the sides of a sector coincide to six digits
RING = "the sector is expanded to the ring: CalculiX's frequencies of some nodal diameters are among clatter's of all"

# name, what it shows, largest error allowed, reason for an error above the printed digits
CASES = [
    ("beam8p", "C3D8, forces", PRINTED, ""),
    ("beam10p", "C3D10, forces", PRINTED, ""),
    ("beam20p", "C3D20, forces", PRINTED, ""),
    ("c3d15", "C3D15, pressure, orientation", PRINTED, ""),
    ("beamp", "C3D20R, forces", 1e-6, "six digits in the .frd file"),
    ("beamd", "C3D20R, pressure", PRINTED, ""),
    ("beamidset", "sets within sets", PRINTED, ""),
    ("beampset", "sets of nodes", PRINTED, ""),
    ("beamp2stage", "two stages of loading", PRINTED, ""),
    ("beampis", "iterative solver of CalculiX", PRINTED, ""),
    ("beampic", "iterative solver of CalculiX", 2e-3, "CalculiX's solver stops early: beampis, the same deck with another preconditioner, agrees"),
    ("beampo1", "orthotropic, orientation", PRINTED, ""),
    ("beampo2", "orthotropic, orientation", PRINTED, ""),
    ("aniso", "anisotropic, 21 constants", PRINTED, ""),
    ("achteld", "prescribed displacement", PRINTED, ""),
    ("achtelp", "forces, symmetry planes", PRINTED, ""),
    ("achtelg", "gravity", PRINTED, ""),
    ("achtel2", "equations", PRINTED, ""),
    ("achtel29", "equations", PRINTED, ""),
    ("achtel9", "equations", PRINTED, ""),
    ("achtelcas", "equations", PRINTED, ""),
    ("beampdepmpc", "dependent equations", PRINTED, ""),
    ("segmentf", "transform, cylindrical", PRINTED, ""),
    ("beamprb", "rigid body with rotation node", 3e-6, "six digits in the .frd file"),
    ("beamptied1", "tie", PRINTED, ""),
    ("beamptied2", "tie", PRINTED, ""),
    ("beam8t", "C3D8, temperature", PRINTED, ""),
    ("beamt", "C3D20R, temperature", PRINTED, ""),
    ("beamt2", "C3D20R, temperature", PRINTED, ""),
    ("beamt3", "C3D20R, temperature of mid-side nodes", PRINTED, ""),
    ("beam8f", "C3D8, frequencies", PRINTED, ""),
    ("beamf", "C3D20R, frequencies", 2e-3, "clatter's mass is exact, CalculiX uses the eight points of K"),
    *((f"beamdy{i}", "first step: C3D20R, frequencies", 2e-3, "mass as in beamf; the dynamic step is left out")
      for i in range(1, 20)),
    ("dloadlinIf", "C3D8I, frequencies, superfluous nodes", 3e-6, "probably the inertia that CalculiX gives incompatible modes"),
    ("achtelc", "centrifugal force", PRINTED, ""),
    ("segment1", "centrifugal force, curved C3D20R", 1e-2, "clatter's load is exact, CalculiX uses the eight points of K"),
    ("segment1, eight-point load", "the same with CalculiX's load", PRINTED, "explains the difference in the row above (reduced_mass.py)"),
    ("segment2", "centrifugal force, curved C3D20R", 1e-2, "clatter's load is exact, CalculiX uses the eight points of K"),
    ("segment2, eight-point load", "the same with CalculiX's load", PRINTED, "explains the difference in the row above (reduced_mass.py)"),
    ("beampfix", "first step: forces", PRINTED, "the step that holds DoFs moved by the first one is left out"),
    ("changesolidsection", "first step: forces", PRINTED, "the step with another material is left out"),
    ("beamt6", "first step: temperature", PRINTED, "the coupled step is left out"),
    ("beamf, eight-point mass", "the same with CalculiX's mass", PRINTED, "explains the difference in the row above (reduced_mass.py)"),
    ("c3d6", "C3D6, forces", PRINTED, "read with --ignore *MEMBRANE, a section without elements"),
    ("beammrlin", "mean rotation (*MPC)", PRINTED, ""),
    ("dashpot1", "first step: spring and dashpot, frequency", PRINTED, "dampers are left out, and the dynamic step"),
    ("dashpot2", "first step: spring and dashpot, frequency", PRINTED, "dampers are left out, and the dynamic step"),
    ("dashpot3", "first step: spring and dashpot, frequency", PRINTED, "dampers are left out, and the dynamic step"),
    ("spring5", "first step: spring, frequency", PRINTED, "the dynamic step is left out"),
    ("damper1", "first step: a free rigid body and a held part", PRINTED, "the dynamic step is left out"),
    ("segment", "cyclic symmetry, one nodal diameter", ROUNDED, RING),
    ("segmentface", "cyclic symmetry, one nodal diameter", ROUNDED, RING),
    ("segdyn", "first step: cyclic symmetry, seven nodal diameters", ROUNDED, RING),
    ("segststate", "first step: cyclic symmetry, seven nodal diameters", ROUNDED, RING),
]

# References that a later version of package calculix-ccx-test replaced by others: a number of the new one, and why it is not compared.
CHANGED = {
    "dloadlinIf": ("0.9586253E+01", "the reference of CalculiX 2.22 (and what 2.20 finds) has incompatible modes with mass, which clatter's have not"),
}
# Why decks are refused: a deck counts once, for the first row that matches one of its errors.
CAUSES = [
    ("networks of fluids, fluid cells", r"element type (D|F3D\w*) "),
    ("shells, membranes", r"elements (S|M3D)\w+ are shells|no solid elements but .*\d (S|M3D)\d"),
    ("beams, trusses", r"element type B\d|elements (B|T3D)\w+ are beams|no solid elements but .*\d (B|T3D)\d"),
    ("plane and axisymmetric cells",
     r"element type CAX\d|elements CP[SE]\w+ are shells|no solid elements but .*\d CP[SE]\d"),
    ("gaps", r"element type GAP"),
    ("user elements", r"element type U"),
    ("contact", r"contact( with \S+)? opens and slides"),
    ("deformation plasticity, hyperelasticity, materials of users",
     r"keyword \*(DEFORMATION PLASTICITY|HYPER|USER MATERIAL|DEPVAR|MOHR|VISCO)"),
    ("heat, mass and acoustics alone or coupled",
     r"keyword \*(HEAT TRANSFER|COUPLED TEMP|UNCOUPLED TEMP|FLUID CONSTANTS|ELECTRO|MAGNETIC|FILM|RADIATE|DFLUX|CFLUX)"),
    ("dynamics in time as the first step", r"keyword \*(DYNAMIC|MODAL DYNAMIC|STEADY STATE)"),
    ("buckling as the first step", r"keyword \*BUCKLE"),
    ("sensitivities, Green functions, crack growth", r"keyword \*(SENSITIVITY|GREEN|CRACK|FEASIBLE|ROBUST|OBJECTIVE)"),
    ("large displacements in the first step (read with --ignore NLGEOM)", r"NLGEOM"),
    ("parts of other models, changes of the model",
     r"\*(SUBMODEL|MODEL CHANGE|CHANGE |RESTART|INCLUDE)"),
    ("springs or points alone, no cell", r"found no solid cells|no cells"),
    ("initial stress or strain", r"\*INITIAL CONDITIONS"),
    ("cyclic symmetry of several stages or of sides not meshed alike", r"CYCLIC|MULTISTAGE|on the sides"),
    ("constants that depend on the temperature in steps that change it", r"depend on the temperature|change it"),
]
RINGS = ("segment", "segmentface", "segdyn", "segststate")
SECTORS = 12  # of each of them
# Texts of decks that are replaced for both programs.
FULL = "as C3D20: with C3D20R its bars of single cells are mechanisms, which clatter refuses"
REPLACED = {"pret1": ("TYPE=C3D20R", "TYPE=C3D20")}
# The same, compared with ccx or with what is stored of its results.
SOLVED = [
    ("mpcforce", "equations across two materials", PRINTED, ""),
    ("pret1", "pre-tension of a bolt", PRINTED, FULL),
    ("segmentm", "transform, equations", PRINTED, ""),
    ("disk2", "centrifugal force on a part, transform, equations", 1e-4, "clatter's load is exact, CalculiX uses the eight points of K"),
    ("distcoup", "distributing coupling off its centre", PRINTED, "read with --ignore MOMENT"),
    ("sens_orien1", "first step: orthotropic, orientation", PRINTED, "the sensitivity is left out"),
    ("sensitivity_I", "first step: forces", PRINTED, "the sensitivity is left out"),
    ("sensitivity_V", "first step: forces", PRINTED, "the sensitivity is left out"),
    ("sensitivity_VI", "first step: forces", PRINTED, "the sensitivity is left out"),
    ("beampsensfreq", "first step: forces", PRINTED, "read with --ignore 'EXTRA NODES'; frequencies under load and sensitivity are left out"),
    ("beamf2", "first step: forces", PRINTED, "frequencies under load are left out"),
]
SMALL = "CalculiX at 1e-5 of the load: with these *MPC it includes large displacements with and without NLGEOM"
# The same, with NLGEOM ignored by both programs.
LINEAR = [
    ("beamnlp", "forces", PRINTED, ""),
    ("beamnlptp", "forces", PRINTED, ""),
    ("beamnld", "prescribed displacement", PRINTED, ""),
    ("beamnlmpc", "equations", PRINTED, ""),
    ("beamnlt", "temperature", PRINTED, ""),
    ("beammr", "mean rotation (*MPC)", PRINTED, ""),
    ("beammrco", "mean rotation (*MPC)", PRINTED, ""),
    ("beamplane", "nodes in a plane (*MPC)", 2e-5, SMALL),
    ("beamstraight", "nodes on a line (*MPC)", 2e-5, SMALL),
    ("beamrb", "rigid body", PRINTED, ""),
    ("beamrb2", "rigid body", PRINTED, ""),
    ("beamp1rotate", "prescribed displacement", PRINTED, ""),
    ("beamp2rotate", "first step: prescribed displacement", PRINTED, "the next steps are left out"),
    ("beamdynamic", "first step: forces", PRINTED, "the dynamic step is left out"),
    ("spring3", "first step: spring, forces", PRINTED, "the step after it is left out"),
    ("rotor", "first step: centrifugal force, curved C3D20R", 1e-2, "as segment1; frequencies under load are left out"),
    ("dloadlinI", "C3D8I, pressure", 3e-6, "read with --ignore 'EXTRA NODES'; as dloadlinIf"),
]
# Loads of the decks of SMALL, in the deck and scaled by 1e-5.
SMALL_LOADS = {"beamplane": ("22,2,200.", "22,2,.002"), "beamstraight": ("22,2,200.", "22,2,.002")}

# Arguments of --ignore that a deck needs.
IGNORE = {
    "dloadlinI": ("EXTRA NODES", "NLGEOM"),
    "dloadlinIf": ("EXTRA NODES",),
    "distcoup": ("MOMENT",),
    "beampsensfreq": ("EXTRA NODES",),
    "c3d6": ("*MEMBRANE",),
}
