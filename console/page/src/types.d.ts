declare module "advice.json" {
  const rows: unknown;
  export default rows;
}
declare module "*.css";
