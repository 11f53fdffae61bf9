# SPDX-License-Identifier: MIT
"""The pages' code in Python runs, each page's from its first block to its last."""

import contextlib
import io
import os
import re
import unittest

import support


class Pages(support.Case):
    def test_python(self):
        page = (support.SOURCES / "docs/python.md").read_text(encoding="utf-8")
        blocks = re.findall(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        self.assertGreater(len(blocks), 3)
        before = os.getcwd()
        os.chdir(self.folder)
        self.addCleanup(os.chdir, before)
        names = {}
        with contextlib.redirect_stdout(io.StringIO()):
            for block in blocks:
                exec(compile(block, "docs/python.md", "exec"), names)


if __name__ == "__main__":
    unittest.main()
