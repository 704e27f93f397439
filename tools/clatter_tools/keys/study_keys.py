# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys of study.toml and parameters.toml, which the tools read."""
from .rows import below, key, table

ANY = {"types": ["number", "text", "flag", "list"], "shape": "a number, text, true, false, or a list with one for each key"}
NAMED_KEY = "file.toml:table.key of the pipeline's folder"
ONE_KEY = (key("key", "text", f"what is changed: {NAMED_KEY}"), key("keys", "texts", "several keys that are changed together"))

SETTING = table("setting", "a setting that is varied, one at a time", [
    key("name", "text", "name in tables and diagrams", required=True),
    key("unit", "text", "unit of the values, for tables and diagrams", default='""', types=["text", "empty"], shape="text"),
    *ONE_KEY,
    key("values", "list", "values from coarse to fine, at most 100; a list for each where several keys are changed", required=True),
    key("base", "either", "the value in the other variants; that of the pipeline without it", **ANY),
    key("reference", "choice", "what errors are differences from: the finest value, or an extrapolation to step 0", default='"auto"',
        choices=["auto", "finest", "richardson"]),
    key("sizes", "numbers", "step sizes of the values, which fall; from the values without it", above=0.0),
], one_of=[("key", "keys")])

# Own keys of what is taken: {take: names}; those with ... have no default.
TAKEN = {
    "frequency": {"number": ...},
    "line": {"sensor": ..., "at_hz": ...},
    "slap_time": {"part": 0.75, "to_hz": 0.0},
    "slap_height": {"to_hz": 0.0},
    "rings_until": {"to_hz": 0.0},
    "third_octaves": {"of": ..., "from_hz": 0.0, "to_hz": 1e9},
    "power_dba": {},
    "erp_dba": {"panel": "exposed"},
    "order": {"of": ..., "order": ...},
    "link_force": {"chain": ...},
    "loss": {"element": ...},
    "cost": {},
    "dataset": {"path": ..., "reduce": "last", "column": 0, "last_cycle_only": True},
}
REDUCE = ["first", "last", "min", "max", "largest", "range", "mean", "rms", "curve"]

TAKE = [
    key("take", "choice", "what is taken", choices=list(TAKEN), required=True),
    key("number", "integer", "frequency: of the mode, in the file's order", min=1),
    key("sensor", "text", "line: label of a sensor's channel"),
    key("at_hz", "number", "line: the nearest line is taken", unit="Hz"),
    key("part", "number", "slap_time: part of the largest acceleration at which a slap begins; 1 for its instant", above=0.0, max=1.0),
    key("from_hz", "number", "third_octaves: lower end of the band", unit="Hz"),
    key("to_hz", "number", "third_octaves, slap_time, slap_height, rings_until: upper end of the band; as far as there are spectra without it",
        unit="Hz"),
    key("of", "text", "third_octaves and order: sound, panels/NAME, sensors/LABEL, and of an order also a history"),
    key("order", "number", "order: multiple of the crank's speed"),
    key("panel", "text", "erp_dba: name of a panel; exposed without it"),
    key("chain", "text", "link_force: name of a chain"),
    key("element", "text", "loss: name of a force element"),
    key("path", "text", "dataset: its path in the file, or group@attribute"),
    key("reduce", "choice", "dataset: to which number; last without it; mean and rms of a history are over time, as its steps are unequal", choices=REDUCE),
    key("column", "integer", "dataset: of a table, from 0", min=0),
    key("last_cycle_only", "flag", "dataset: whether a history is cut to its last cycle, as it is without the key"),
]

EXACT = table("exact", "the exact value from a file", [key("file", "path", "an artefact", required=True), *TAKE])

QUANTITY = table("quantity", "a number or curve whose error is looked at", [
    key("name", "text", "name in tables and diagrams", required=True),
    key("file", "text", "an artefact of the pipeline's folder, as slap.field.h5", required=True),
    *TAKE,
    key("unit", "text", "unit for tables; that of what is taken without it", types=["text", "empty"], shape="text"),
    key("error", "choice", "how the error is given; absolute for levels and times without it, else relative", choices=["relative", "absolute"]),
    key("small", "number", "a change, as errors are given, that does not matter; 0.01 of relative errors and 0.1 dB without it", min=0.0),
    key("exact", "either", "an exact value, from which errors are taken instead of the finest variant", types=["number", "table"],
        shape="a number or a table", table=EXACT),
])

EFFECT = table("effect", "an effect that a study with --effects switches off or on", [
    key("name", "text", "name in tables and diagrams", required=True),
    *ONE_KEY,
    key("off", "either", "value of the key that switches the effect off", **ANY),
    key("on", "either", "value of the key that switches the effect on", **ANY),
], one_of=[("key", "keys")])

STUDY = table("study.toml", "what `clatter study` varies and measures", [
    key("pipeline", "path", "folder with the Makefile that makes the artefacts", default='"."'),
    key("check", "flag", "whether the fully refined variant is made too, which proves that single errors add up", default="true"),
    key("reuse", "flag", "whether artefacts of the pipeline's folder are taken over instead of made again", default="false"),
    key("cost", "choice", "what counts: seconds that pass, or those of all processors", default='"seconds"', choices=["seconds", "processor"]),
    below("setting", "tables", SETTING),
    below("quantity", "tables", QUANTITY),
    below("effect", "tables", EFFECT),
])

PARAMETERS = table("parameters.toml", "parameters that `clatter sweep --parameters` varies one at a time", [
    below("parameter", "tables", table("parameter", "a parameter and its values", [
        key("name", "text", "name of the scenes, and in tables and pictures", required=True),
        key("unit", "text", "unit of the values"),
        key("base", "either", "value of the base scene, for tables and pictures", types=["number", "text"], shape="a number or a text"),
        key("values", "list", "numbers or texts, at most 1000", required=True),
        key("keys", "texts by name", "keys of the scene and their values, in which {} is the value; {} alone has its type", required=True),
        key("field", "text", "settings of clatter-recover for these runs, a file as seen from the folder of the scenes"),
    ])),
])
