# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter keys` and `clatter schema`: what they say is what the programs read."""
import json
import pathlib
import re
import tomllib
import unittest

from clatter_command import clatter
from clatter.errors import BadArtefact
from clatter_tools.keys import files, pages, rows, schema, schema_line, words

SOURCE = pathlib.Path(__file__).resolve().parents[2]

SPRING = rows.table("spring.toml", "a spring", [
    rows.key("law", "choice", "force over length", choices=["linear", "table"], default='"linear"'),
    rows.key("rate_n_m", "number", "force over deflection", unit="N/m", above=0.0, rules=[{"kind": "excludes", "other": "file", "reason": "it has its own"}]),
    rows.key("file", "path", "of the table", rules=[{"kind": "needs", "other": "law", "values": ["table"]}, {"kind": "required_with", "other": "law", "values": ["table"]}]),
    rows.key("ends", "numbers", "of the travel", count=2, min=-1.0, max=1.0),
    rows.below("seat", "tables", rows.table("seat", "a seat", [rows.key("name", "text", "its name", required=True)])),
])


class Check(unittest.TestCase):
    def refused(self, text, said):
        with self.assertRaisesRegex(BadArtefact, said):
            rows.check("a.toml", tomllib.loads(text), SPRING)

    def test_what_is_wrong_is_named(self):
        rows.check("a.toml", tomllib.loads("rate_n_m = 5\nends = [0, 1]\n[[seat]]\nname = 'low'"), SPRING)
        self.refused("rate = 5", r"^a.toml: rate: unknown key, did you mean rate_n_m\?$")
        self.refused("rate_n_m = 0", r"^a.toml: rate_n_m: found 0, expected a number above 0$")
        self.refused("law = 'square'", "law: found 'square', expected one of: linear, table")
        self.refused("[[seat]]\nnam = 'low'", r"seat\[0\].nam: unknown key, did you mean name\?")
        self.refused("[[seat]]", r"seat\[0\].name: found nothing, expected a text")
        self.refused("law = 'table'", "^a.toml: file: is missing, law = table needs it$")
        self.refused("file = 'a.csv'", "^a.toml: file: needs law = table$")
        self.refused("law = 'table'\nfile = 'a.csv'\nrate_n_m = 3", "rate_n_m and file exclude each other: it has its own$")
        self.refused("ends = [0, 2]", "ends: found .0, 2., expected a list of numbers at least -1 at most 1")


class Schema(unittest.TestCase):
    def test_types_ranges_and_rules_are_those_of_the_rows(self):
        found = schema.of_file(SPRING)
        self.assertEqual(found["properties"]["rate_n_m"], {"description": "force over deflection [N/m]", "type": "number", "exclusiveMinimum": 0.0})
        self.assertEqual(found["properties"]["law"], {"description": "force over length", "enum": ["linear", "table"], "default": "linear"})
        self.assertEqual(found["properties"]["ends"], {"description": "of the travel", "type": "array", "items": {"type": "number", "minimum": -1.0, "maximum": 1.0},
                                                       "minItems": 2, "maxItems": 2})
        self.assertIs(found["additionalProperties"], False)
        self.assertEqual(found["properties"]["seat"]["items"], {"$ref": "#/definitions/seat"})
        self.assertEqual(found["definitions"]["seat"]["required"], ["name"])
        self.assertIn({"not": {"allOf": [{"required": ["rate_n_m"]}, {"required": ["file"]}]}}, found["allOf"])
        self.assertIn({"if": {"required": ["file"]}, "then": {"properties": {"law": {"enum": ["table"]}}, "required": ["law"]}}, found["allOf"])

    def test_a_file_with_a_base_may_lack_everything_and_change_one_entry_of_a_list(self):
        found = schema.of_file({**SPRING, "keys": [*SPRING["keys"], rows.key("base", "path", "another file")]})
        self.assertNotIn("required", found["definitions"]["seat"])
        self.assertEqual(found["properties"]["seat"]["anyOf"][1]["type"], "object")
        self.assertEqual(found["if"], {"not": {"required": ["base"]}})
        self.assertEqual(found["then"]["properties"]["seat"], {"type": "array", "items": {"$ref": "#/definitions/seat_complete"}})
        self.assertEqual(found["definitions"]["seat_complete"], {"required": ["name"]})

    def test_equal_tables_are_written_once_and_others_of_the_same_name_get_a_number(self):
        def end(name, *keys):
            return rows.below(name, "table", rows.table(name, "an end", [rows.below("seat", "table", rows.table("seat", "a seat", [*keys]))]))
        wide, high = rows.key("wide", "flag", "it is"), rows.key("high", "flag", "it is")
        found = schema.of_file(rows.table("x.toml", "ends", [end("a", wide), end("b", wide), end("c", high)]))
        self.assertEqual(set(found["definitions"]), {"a", "b", "c", "seat", "seat_2"})
        self.assertEqual([found["definitions"][name]["properties"]["seat"]["$ref"] for name in "abc"],
                         ["#/definitions/seat", "#/definitions/seat", "#/definitions/seat_2"])

    def test_the_kind_of_a_file_is_the_end_of_its_name(self):
        for name, kind in (("slap.run.toml", "run"), ("a/field.toml", "field"), ("other.toml", ""), ("x.mesh.toml", "mesh")):
            self.assertEqual(schema_line.kind_of(name), kind)

    def test_every_sample_names_the_schema_of_its_kind(self):
        samples = sorted((SOURCE / "samples").glob("*/*.toml"))  # without those of sweeps and studies, which users make
        self.assertGreater(len(samples), 40)
        for path in samples:
            found = re.match(r"(?:# SPDX.*\n)?#:schema (\S+)\n", path.read_text())
            self.assertIsNotNone(found, path)
            target = (path.parent / found[1]).resolve()
            self.assertEqual(target.parent, SOURCE / "build/release/share/clatter/schemas", path)
            kind = target.name.removesuffix(".schema.json")
            self.assertIn(kind, files.KINDS)
            self.assertIn(kind, re.split(r"[._]", path.name.removesuffix(".toml")), path)


class Pages(unittest.TestCase):
    def test_a_row_has_meaning_unit_rules_values_and_default(self):
        lines = pages.section(SPRING)
        self.assertIn('| `law` | force over length | "linear" \\| "table" | `"linear"` |', lines)
        self.assertIn("| `rate_n_m` | force over deflection [N/m]; not with file (it has its own) | number above 0 |  |", lines)
        self.assertIn("## `[[seat]]`", lines)
        self.assertIn("| `name` | its name | text | required |", lines)


class Command(unittest.TestCase):
    def test_tables_keys_and_words_are_found(self):
        self.assertIn("the closed surface that radiates", clatter("keys", "sound", "skin", folder=SOURCE).stdout)
        one = clatter("keys", "sound", "skin.opening", folder=SOURCE).stdout
        self.assertRegex(one, r"skin.opening +diameter up to which holes are closed by lids; .* \[m\]\n +number above 0\n")
        found = clatter("keys", "lids", folder=SOURCE).stdout
        self.assertIn("sound.toml", found)
        self.assertIn("skin.opening", found)
        self.assertIn("setting.values", clatter("keys", "study", "values", folder=SOURCE).stdout)
        wrong = clatter("keys", "sound", "skin.openning", folder=SOURCE)
        self.assertEqual((wrong.returncode, wrong.stdout), (2, ""))
        self.assertRegex(wrong.stderr, r"^clatter: error: skin.openning: in no name, meaning or default of a key, did you mean \w+")

    def test_defaults_in_the_schema_are_what_the_program_says(self):
        found = json.loads(clatter("schema", "field", folder=SOURCE).stdout)
        tables = found["definitions"]
        self.assertEqual(found["properties"]["window"]["items"], {"$ref": "#/definitions/window"})
        self.assertEqual(tables["frames"]["properties"]["from_deg"]["default"], -10)
        self.assertEqual(tables["window"]["required"], ["name"])
        self.assertIs(tables["window"]["additionalProperties"], False)

    def test_all_that_a_program_describes_has_a_meaning(self):
        for kind, table in files.read()[0].items():
            for path, key in files.walk(table):
                self.assertTrue(key["meaning"], f"{kind}.toml: {path}")
                self.assertFalse(key["meaning"].endswith("."), f"{kind}.toml: {path}: {key['meaning']}")
                self.assertTrue(words.values_of(key) if "table" not in key else True)


if __name__ == "__main__":
    unittest.main()
