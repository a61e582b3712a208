"""The schemes, one function each: from a whole state to the next. Right ones, engines' own, deliberately wrong ones."""
