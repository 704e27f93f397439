# SPDX-License-Identifier: GPL-3.0-or-later
"""A flipped bit in a finished artefact: programs that read the number or text refuse it, `clatter info --verify`
names it; files without checksums are read."""
import random
import subprocess
import unittest

import h5py
import numpy as np
import stages
from observed import expect_at_least

TOOL = stages.SOURCE / "tools/clatter"
FLIPPED = 8  # datasets of each artefact
ANYWHERE = 40  # bytes of the entire file


def numbers(path):
    """Contents of an artefact except times and hashes, which differ from run to run."""
    found = {}

    def take(name, item):
        if name.startswith(("timing", "inputs", "statistics")):
            return
        found[name] = item[()] if isinstance(item, h5py.Dataset) else None
    with h5py.File(path) as file:
        file.visititems(take)
    return found


def stored(path):
    """{dataset: (offset, bytes) of its first chunk} of all that is not empty."""
    chunks = {}

    def take(name, item):
        if isinstance(item, h5py.Dataset) and item.size:
            chunk = item.id.get_chunk_info(0)
            chunks[name] = (chunk.byte_offset, min(chunk.size, item.size * item.dtype.itemsize))
    with h5py.File(path) as file:
        file.visititems(take)
    return chunks


class FlippedBits(stages.PipelineTest):
    # A stage that reads each artefact and writes another one quickly.
    READERS = {"beam.mesh.h5": ("assembly", ["beam.mesh.h5", "-c", "beam.fe.toml", "-o", "out.h5"]),
               "beam.fe.h5": ("modal", ["beam.fe.h5", "--count", "1", "-o", "out.h5"]),
               "beam.rom.h5": ("dynamics", ["step.run.toml", "-o", "out.h5"]),
               "step.run.h5": ("recover", ["step.run.h5", "-c", "step.field.toml", "-o", "out.h5"])}

    def flip(self, path, draw, chunk):
        """Flips a bit of the file in these bytes (offset, length)."""
        data = bytearray(path.read_bytes())
        data[chunk[0] + draw.randrange(chunk[1])] ^= 1 << draw.randrange(8)
        path.write_bytes(data)

    def verify(self, path):
        return subprocess.run([TOOL, "info", "--verify", path.name], cwd=self.folder, capture_output=True, text=True)

    def test_every_reader_refuses_a_flipped_number_or_does_not_use_it(self):
        draw = random.Random(5)
        for name, (stage, arguments) in self.READERS.items():
            path, output = self.folder / name, self.folder / "out.h5"
            good, chunks = path.read_bytes(), stored(path)
            stages.run_stage(stage, *arguments, folder=self.folder)
            expected, refused = numbers(output), 0
            for dataset in draw.sample(sorted(chunks), FLIPPED):
                with self.subTest(file=name, dataset=dataset):
                    self.flip(path, draw, chunks[dataset])
                    output.unlink(missing_ok=True)
                    done = stages.run_stage(stage, *arguments, "--quiet", folder=self.folder)
                    if done.returncode == 0:
                        found = numbers(output)
                        self.assertEqual(list(found), list(expected))
                        for key, value in expected.items():
                            np.testing.assert_array_equal(found[key], value, err_msg=key)
                    else:
                        refused += 1
                        self.assertEqual(done.returncode, 2, done.stderr)
                        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                        for text in (name, dataset, "checksum does not match: the file was damaged after it was written"):
                            self.assertIn(text, done.stderr)
                        self.assertFalse(output.exists())
                    path.write_bytes(good)
            expect_at_least(self, f"flipped datasets of {name} that were refused", refused, FLIPPED // 4)

    def test_a_byte_anywhere_is_refused_in_a_line_or_changes_nothing(self):
        """Headers, indices, names and attributes included: no flip makes the HDF5 library crash."""
        draw, refused = random.Random(8), 0
        for source, (stage, arguments) in {
                "beam.mesh.h5": ("mesh", ["export", "beam.mesh.h5", "out.inp"]),
                "beam.rom.h5": ("condense", ["export", "beam.rom.h5", "out.inp"])}.items():
            path, output = self.folder / source, self.folder / "out.inp"
            good = path.read_bytes()
            stages.run_stage(stage, *arguments, folder=self.folder)
            expected = output.read_bytes()
            inside = [(at, at + size) for at, size in stored(path).values()]  # numbers, which other tests flip
            rest = [at for at in range(len(good)) if not any(low <= at < high for low, high in inside)]
            for at in draw.sample(rest, ANYWHERE):
                with self.subTest(file=source, byte=at):
                    path.write_bytes(good[:at] + bytes([good[at] ^ draw.randrange(1, 256)]) + good[at + 1:])
                    output.unlink(missing_ok=True)
                    done = stages.run_stage(stage, *arguments, "--quiet", folder=self.folder)
                    if done.returncode == 0:
                        self.assertEqual(output.read_bytes(), expected)
                    else:
                        refused += 1
                        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
                        self.assertIn(source, done.stderr)
                        self.assertFalse(output.exists())
            path.write_bytes(good)
        self.assertGreater(refused, 0)  # most bytes of the reduced model are not read for this export

    def test_a_text_that_h5py_edited_is_read_and_reported_without_checksum(self):
        with h5py.File(self.folder / "beam.fe.h5", "r+") as file:
            file["loads/tip_force"].attrs["unit"] = "N"
        done = stages.run_stage("condense", *self.command("condense"), "--quiet", folder=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("no checksums of 1 object: loads/tip_force@unit", self.verify(self.folder / "beam.fe.h5").stderr)

    def test_verification_names_the_dataset_in_every_kind_of_artefact(self):
        draw = random.Random(6)
        stages.run_stage("modal", "statics", "beam.fe.h5", "-o", "beam.static.h5", folder=self.folder)
        for path in sorted(self.folder.glob("*.h5")):
            with self.subTest(file=path.name):
                done = self.verify(path)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn("every number and text is undamaged", done.stdout)
                dataset, chunk = draw.choice(sorted(stored(path).items()))
                self.flip(path, draw, chunk)
                done = self.verify(path)
                self.assertEqual(done.returncode, 2, dataset)
                self.assertIn(f"{path.name}: damaged after it was written: {dataset}", done.stderr)

    def test_a_file_without_checksums_is_read_and_reported_as_such(self):
        path = self.folder / "beam.fe.h5"
        expected = numbers(path)
        plain = self.folder / "plain.h5"
        with h5py.File(path) as old, h5py.File(plain, "w") as new:
            new.attrs.update(old.attrs)

            def copy(name, item):
                if isinstance(item, h5py.Dataset):
                    new[name] = item.asstr()[()] if item.dtype.kind == "S" else item[()]
                else:
                    new.require_group(name)
                new[name].attrs.update(item.attrs)
            old.visititems(copy)
        plain.replace(path)
        self.assertEqual(list(numbers(path)), list(expected))
        done = stages.run_stage("condense", *self.command("condense"), "--quiet", folder=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        shown = subprocess.run([TOOL, "info", path.name], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("no checksums", shown.stdout)
        done = self.verify(path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("cannot be verified, no checksums", done.stderr)

    def test_the_three_lines_of_the_formats_read_a_checked_matrix(self):
        import scipy.sparse as sp
        g = h5py.File(self.folder / "beam.fe.h5")["K"]
        K = sp.csc_matrix((g["data"][()], g["indices"][()], g["indptr"][()]), shape=g.attrs["shape"])
        self.assertTrue(g["data"].fletcher32)
        self.assertGreater(len(list(g["data"].iter_chunks())), 1)
        self.assertEqual(K.nnz, len(g["data"]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
