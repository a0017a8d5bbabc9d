"""The wheel holds a compiled module: it is one of this Python on this processor."""

from setuptools import Distribution, setup


class Compiled(Distribution):
    def has_ext_modules(self) -> bool:
        return True


setup(distclass=Compiled)
