"""What students hand in: files, notebooks, zips, folders; and whose they are."""
