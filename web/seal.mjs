// Writes static/built.json: digests of the sources and of the files built from them, by which a
// test without Node sees that they belong together.

import { createHash } from "node:crypto";
import { readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";

const BUILT = "../src/sgim/web/static";
const SOURCES = ["index.html", "package.json", "package-lock.json", "tsconfig.json", "vite.config.js", "src", "public"];

function digests(root, paths) {
  const found = {};
  const visit = (path) => {
    const full = join(root, path);
    if (statSync(full).isDirectory()) readdirSync(full).sort().forEach((name) => visit(`${path}/${name}`));
    else found[path] = createHash("sha256").update(readFileSync(full)).digest("hex");
  };
  paths.forEach(visit);
  return found;
}

const built = readdirSync(BUILT).filter((name) => name !== "built.json").sort();
const seal = { sources: digests(".", SOURCES), built: digests(BUILT, built) };
writeFileSync(join(BUILT, "built.json"), JSON.stringify(seal, null, 1) + "\n");
