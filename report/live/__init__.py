"""The live lab: scenes that run in the browser, with every parameter to be moved and the theory beside the motion.

The physics of it knows nothing of pages and can be tested alone: `timeline` (lanes advance in step, and go back), `lab`
(what people do with them), `lane`, `stepping`, `prediction`, `reference_run`, `recorder`, `history`, `segment`,
`reproduction`. The page is a thin layer on top: `page`, `controls`, `stage`, `plots`, `server`.
"""
