"""What asv times, commit by commit: see benchmarks/speed/README.md, History."""
