"""Values to text: problems, results and boards for terminals, files and other programs."""
