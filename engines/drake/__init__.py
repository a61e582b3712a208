"""Drake: bodies joined by linear spring-dampers, in discrete steps and under its integrators at a fixed step."""
