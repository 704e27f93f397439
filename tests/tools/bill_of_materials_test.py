# SPDX-License-Identifier: GPL-3.0-or-later
"""tools/bill_of_materials: what a Debian package is and what it depends on, of a small package that is made here."""
import hashlib
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools/bill_of_materials"
CONTROL = """Package: small
Version: 1.2
Architecture: all
Maintainer: nobody <nobody@example.org>
Depends: libc6 (>= 2.3), no-such-package | coreutils (>= 1), never-there (= 3)
Description: a test
"""
if not (shutil.which("dpkg-deb") and shutil.which("dpkg-query")):
    print("skipped: dpkg is not installed")
    sys.exit(77)


class Bill(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        (self.folder / "small/DEBIAN").mkdir(parents=True)
        (self.folder / "small/DEBIAN/control").write_text(CONTROL)
        self.deb = self.folder / "small.deb"
        subprocess.run(["dpkg-deb", "--build", "--root-owner-group", self.folder / "small", self.deb], check=True, capture_output=True)

    def run_tool(self, *arguments):
        return subprocess.run([TOOL, *arguments], capture_output=True, text=True, check=False)

    def test_the_package_its_digest_and_its_dependencies_with_the_installed_versions(self):
        done = self.run_tool(self.deb)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        packages = {one["name"]: one for one in found["packages"]}
        self.assertEqual(set(packages), {"small", "libc6", "coreutils", "never-there"})
        own = packages["small"]
        self.assertEqual((own["versionInfo"], own["checksums"][0]["checksumValue"]), ("1.2", hashlib.sha256(self.deb.read_bytes()).hexdigest()))
        version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "coreutils"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(packages["coreutils"]["versionInfo"], version)
        self.assertNotIn("versionInfo", packages["never-there"])
        needed = {one["relatedSpdxElement"] for one in found["relationships"] if one["relationshipType"] == "DEPENDS_ON"}
        self.assertEqual(needed, {one["SPDXID"] for name, one in packages.items() if name != "small"})

    def test_what_is_no_package_is_refused_in_one_line(self):
        (self.folder / "text.deb").write_text("no package")
        for arguments in ((), (self.folder / "missing.deb",), (self.folder / "text.deb",)):
            done = self.run_tool(*arguments)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("bill_of_materials: error: "), done.stderr)


if __name__ == "__main__":
    unittest.main()
