"""ambrig: magnetic-bearing rigs with redundant actuators - simulate, break, compare, explain.

    import ambrig
    rig = ambrig.load("rig.toml")
    rig["controller.kp"] = 5.0e5
    run = ambrig.run("scenario.toml", rig)
    run["A.x"], run.units["A.x"], run.verdict
"""
from .commands import (Answer, adopt, analyze, call, campaign, check, compare, explain, export, plan,
                       redistribute, refine)
from .document import Document, Rig, Scenario, load, load_rig, load_scenario
from .errors import InputError, NoSolution
from .record import Record, Run, read, run

__version__ = "0.1.0"
__all__ = ["Answer", "Document", "InputError", "NoSolution", "Record", "Rig", "Run", "Scenario", "adopt", "analyze",
           "call", "campaign", "check", "compare", "explain", "export", "load", "load_rig", "load_scenario", "plan",
           "read", "redistribute", "refine", "run"]
