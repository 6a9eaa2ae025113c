"""Params of packs are set within their ranges."""
import unittest

import numpy as np

import oriel
from support import HOUSE, FolderTest

EXTENDING = """schema: oriel/1
pack: {name: wide, version: 1.0.0}
extends: residential
params:
  widest_leaf: {value: 1.3 m}
  parapet: {value: 0.7 m}
"""


class PacksTest(FolderTest):
    def test_params_have_a_value_a_unit_and_a_reason(self):
        params = oriel.Pack("residential").params
        self.assertGreater(len(params), 20)
        leaf = params["widest_leaf"]
        self.assertEqual((leaf.name, leaf.unit, leaf.range), ("widest_leaf", "m", (1.0, 1.3)))
        self.assertTrue(all(param.why for param in params.values()))

    def test_a_changed_pack_says_what_a_pack_that_extends_it_says(self):
        stream, _ = self.houses(2)
        segmented = oriel.features(oriel.segment(stream))
        pack = oriel.Pack("residential")
        changed = pack.with_params(widest_leaf=1.3, parapet="0.7 m")
        self.assertEqual(changed.params["widest_leaf"].value, 1.3)
        self.assertEqual(pack.params["widest_leaf"].value, 1.12)
        by_text, by_number = oriel.interpret(segmented, oriel.Pack.from_text(EXTENDING)), oriel.interpret(segmented, changed)
        for column in ("label", "score", "rule"):
            np.testing.assert_array_equal(by_text[column], by_number[column])
        self.assertEqual(pack.with_params().sha256, pack.sha256)
        self.assertNotEqual(changed.sha256, pack.sha256)

    def test_wrong_params_are_refused(self):
        pack = oriel.Pack("residential")
        for code, values in (("R206", {"widest_leef": 1.2}), ("R212", {"widest_leaf": 5}), ("R212", {"parapet": "9 m"}),
                             ("R230", {"parapet": "0.8 deg"})):
            with self.subTest(values), self.assertRaises(oriel.Error) as caught:
                pack.with_params(**values)
            self.assertEqual(caught.exception.code, code)

    def test_a_pack_is_read_once_for_many_buildings(self):
        pack = oriel.Pack("residential")
        self.assertEqual(oriel.to_text(oriel.label(HOUSE, pack)), oriel.to_text(oriel.label(HOUSE, "residential")))


if __name__ == "__main__":
    unittest.main()
