"""Stubs and options are those of the module and of the command."""
import ast
import inspect
import pathlib
import re
import unittest

import oriel
from oriel import _oriel
from support import run

STUB = pathlib.Path(_oriel.__file__).parent / "_oriel.pyi"


def public_names(value):
    return {name for name in vars(value) if not name.startswith("_")}


def defaults_of(command):
    """The defaults that the help of a command shows, by option with _ for -."""
    found = {}
    for name, kind in re.findall(r"(?m)^ +(?:-\w,)?--([a-z-]+)((?: \S+)*)", run(command, "--help")):
        default = re.search(r"=(\S+)", kind)
        found[name.replace("-", "_")] = default[1] if default else None
    return found


class TypesTest(unittest.TestCase):
    def test_the_stub_has_what_the_module_has(self):
        tree = ast.parse(STUB.read_text(encoding="utf-8"))
        classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
        functions = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
        self.assertEqual(public_names(_oriel), set(classes) | functions)
        for name, node in classes.items():
            members = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
            self.assertEqual(public_names(getattr(_oriel, name)), {m for m in members if not m.startswith("_")}, name)

    def test_options_have_the_names_and_defaults_of_the_command(self):
        compared = 0
        for function in (oriel.label, oriel.segment, oriel.repair, oriel.generalise, oriel.score, oriel.learn):
            shown = defaults_of(function.__name__)
            for name, parameter in inspect.signature(function).parameters.items():
                if parameter.kind != parameter.KEYWORD_ONLY:
                    continue
                with self.subTest(f"{function.__name__} {name}"):
                    self.assertIn(name, shown)
                    if shown[name] and parameter.default is not None:
                        self.assertEqual(type(parameter.default)(shown[name]), parameter.default)
                        compared += 1
        self.assertGreater(compared, 20)

    def test_everything_public_says_what_it_is(self):
        for name in oriel.__all__:
            value = getattr(oriel, name)
            if inspect.isclass(value) or inspect.isfunction(value):
                self.assertTrue(inspect.getdoc(value), name)

    def test_values_say_in_short_what_they_are(self):
        pack = oriel.Pack("residential")
        self.assertIn("residential", repr(pack))
        self.assertIn(pack.name, oriel.embedded_packs())
        self.assertIn("window", pack.labels)
        self.assertEqual(len(pack.sha256), 64)
        with self.assertRaises(oriel.Error) as caught:
            oriel.Pack("mine")
        issue = caught.exception.issues[0]
        self.assertEqual(repr(issue), f"<oriel.Issue error: {issue}>")
        self.assertEqual(str(issue), f"{issue.place}: {issue.code} {issue.sentence}")
        self.assertEqual(oriel.__version__, run("--version").split()[1])


if __name__ == "__main__":
    unittest.main()
