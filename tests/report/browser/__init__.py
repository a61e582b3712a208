"""The lab in a browser: its code in Node against the reference, and the page in Chromium."""
