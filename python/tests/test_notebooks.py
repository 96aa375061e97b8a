"""The notebooks run from top to bottom; what they assert holds."""
import os
import pathlib
import tempfile
import unittest

try:
    import nbclient
    import nbformat
except ImportError:
    nbclient = None

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[1] / "notebooks"


@unittest.skipIf(nbclient is None, "nbclient is not installed")
class Notebooks(unittest.TestCase):
    def executed(self, name):
        notebook = nbformat.read(NOTEBOOKS / name, as_version=4)
        # Inside the project, where a notebook looks for the examples, but in a folder of its own.
        with tempfile.TemporaryDirectory(dir=os.environ.get("AMBRIG_NOTEBOOK_FOLDER", NOTEBOOKS)) as folder:
            nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3",
                                    resources={"metadata": {"path": folder}}).execute()
        kept = os.environ.get("AMBRIG_KEEP_NOTEBOOKS")
        if kept:
            nbformat.write(notebook, pathlib.Path(kept) / name)
        figures = [o for c in notebook.cells for o in c.get("outputs", []) if "image/png" in o.get("data", {})]
        return figures

    def test_fault_run(self):
        self.assertEqual(len(self.executed("fault_run.ipynb")), 2)

    def test_hidden_effect(self):
        self.executed("hidden_effect.ipynb")

    def test_controller_tuning(self):
        self.assertEqual(len(self.executed("controller_tuning.ipynb")), 1)

    def test_every_notebook_is_run(self):
        run = {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")}
        for notebook in NOTEBOOKS.glob("*.ipynb"):
            self.assertIn(notebook.stem, run)


if __name__ == "__main__":
    unittest.main()
