// Bundles what entry.js names into three.txt: one script, deflated and in base64. `cargo xtask bundle` calls it in a copy of this folder.
import { build } from "esbuild";
import { readFileSync, writeFileSync, copyFileSync } from "node:fs";
import { deflateRawSync, inflateRawSync } from "node:zlib";

const bundled = await build({
  entryPoints: ["entry.js"], bundle: true, minify: true, format: "iife", globalName: "T", target: "es2020", write: false,
  // The licence stands beside the script, in the package and in every page.
  legalComments: "none",
});
const script = Buffer.from(bundled.outputFiles[0].contents);
let before = null;
try { before = inflateRawSync(Buffer.from(readFileSync("three.txt", "latin1"), "base64")); } catch { /* there is none yet */ }
copyFileSync("node_modules/three/LICENSE", "LICENSE");
// Deflate differs between versions of node: the script inside decides.
if (before && before.equals(script)) {
  console.log(`three.txt is up to date: ${script.length} bytes of script`);
} else {
  const text = deflateRawSync(script, { level: 9 }).toString("base64");
  writeFileSync("three.txt", text);
  console.log(`three.txt is written: ${script.length} bytes of script, ${text.length} as text`);
}
