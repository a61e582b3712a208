"""Tables and sentences of experiments, read by column and by number, on results made by hand."""
