"""The live lab: scenes that run in the browser, with every parameter to be moved and the theory beside the motion.

The physics of it knows nothing of pages and can be tested alone: `course` (worlds side by side go on), `lab` (what
people change of them), `world`, `stepping`, `prediction`, `history`, `reproduction`. The page is a thin layer on top:
`page`, `stage`, `plots`, `server`.
"""
