// What the bundler makes of files that are not TypeScript.
declare module "conditions.json" {
  const tables: unknown;
  export default tables;
}
declare module "*.css";
