"""What teachers and students get: handouts, sentences, tables, feedback, other graders' formats."""
