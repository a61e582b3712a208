"""How a submission is run: a process of its own, that can reach nothing, and what it leaves."""
