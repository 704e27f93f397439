# SPDX-License-Identifier: GPL-3.0-or-later
"""The samples keep the schemas, and what is wrong breaks them: by taplo, or by python3-jsonschema where npm cannot install it."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import tomllib
import unittest

from clatter_tools.keys import files, schema, schema_line

SOURCE = pathlib.Path(__file__).resolve().parents[2]
TAPLO = next((str(path) for path in (SOURCE / "build/npm/node_modules/.bin/taplo", shutil.which("taplo")) if path and os.path.exists(path)), None)

# A sample and a change that a schema refuses, with what the message has.
WRONG = [("samples/beam/beam.fe.toml", "rho = ", "rhoo = ", "rhoo"), ("samples/beam/beam.mesh.toml", 'kind = "box"', 'kind = "bax"', "bax"),
         ("samples/beam/beam.rom.toml", "boundary = ", "bound = ", "bound"), ("samples/truck_diesel/field.toml", "\n[", "\ncycle = 3\n[", "cycle"),
         ("samples/timing_drive/drive.run.toml", "contact = { bed_n_m3", "contact = { bedd_n_m3", "bedd_n_m3"),
         ("samples/timing_drive/drive.run.toml", "radius_mm = 280.0, from_deg = 194.25", "radius_mm = 280.0", "from_deg")]


def messages_of(path, schema_path):
    """What is wrong with a TOML file; empty when nothing is."""
    if TAPLO:
        done = subprocess.run([TAPLO, "lint", "--no-auto-config", "--schema", schema_path.as_uri(), str(path)], capture_output=True, text=True, check=False)
        return "" if done.returncode == 0 else done.stderr
    import jsonschema
    found = jsonschema.Draft7Validator(json.loads(schema_path.read_text())).iter_errors(tomllib.loads(path.read_text()))
    return "\n".join(str(one) for one in found)


class Schemas(unittest.TestCase):
    def setUp(self):
        if not TAPLO:
            try:
                import jsonschema  # noqa: F401
            except ImportError:
                self.skipTest("needs @taplo/cli of npm, or the package python3-jsonschema")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.tables, _ = files.read()
        self.schemas = {path.name.removesuffix(".schema.json"): path for path in schema.write(self.tables, self.folder)}

    def kind_of(self, path):
        return schema_line.kind_of(path.name) or ("study" if path.name.startswith("study") else "")

    def test_every_sample_keeps_its_schema(self):
        checked = 0
        for path in sorted((SOURCE / "samples").rglob("*.toml")):
            kind = self.kind_of(path)
            if kind in self.schemas:
                self.assertEqual(messages_of(path, self.schemas[kind]), "", path)
                checked += 1
        self.assertGreaterEqual(checked, 25)

    def test_what_is_wrong_is_found(self):
        for name, right, wrong, said in WRONG:
            path = SOURCE / name
            text = path.read_text()
            self.assertIn(right, text, name)
            changed = self.folder / path.name
            changed.write_text(text.replace(right, wrong, 1))
            self.assertIn(said, messages_of(changed, self.schemas[self.kind_of(path)]), name)


if __name__ == "__main__":
    unittest.main()
