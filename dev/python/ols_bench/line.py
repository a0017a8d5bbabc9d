"""A figure of a benchmark, beside what is wanted of it."""


def line(what: str, figure: str, wanted: str) -> None:
    print(f"{what:58s} {figure:28s} {wanted}", flush=True)
