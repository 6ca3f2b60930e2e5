"""What tools/measure.py measures, one module per subcommand."""
