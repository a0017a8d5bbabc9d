// The outermost functions of TypeScript sources, as the compiler reads them: one JSON object a line.
//   node page_functions.mjs COMPILER FILE...
// COMPILER: the folder of the package typescript.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [compiler, ...files] = process.argv.slice(2);
const ts = createRequire(import.meta.url)(compiler);

// An arrow function has the name of what it is the value of: a constant, a property, a member.
function nameOf(node) {
  return node.name ?? (node.parent.initializer === node ? node.parent.name : undefined);
}

function entry(node, source, path) {
  const named = nameOf(node);
  const name = named?.getText() ?? (ts.isConstructorDeclaration(node) ? "constructor" : "unnamed");
  const lineAt = (position) => source.getLineAndCharacterOfPosition(position).line + 1;
  return { path, name, line: lineAt((named ?? node).getStart()), end: lineAt(node.end) };
}

// What stands within a function is counted with it.
function tell(node, source, path) {
  if (ts.isFunctionLike(node) && node.body) console.log(JSON.stringify(entry(node, source, path)));
  else ts.forEachChild(node, (child) => tell(child, source, path));
}

for (const path of files) {
  const source = ts.createSourceFile(path, readFileSync(path, "utf8"), ts.ScriptTarget.Latest, true);
  tell(source, source, path);
}
