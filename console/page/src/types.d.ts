// What the bundler makes of files that are not TypeScript.
declare module "advice.json" {
  const rows: unknown;
  export default rows;
}
declare module "*.css";
