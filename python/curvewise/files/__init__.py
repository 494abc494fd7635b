"""Curves from files: CSV, Excel, MATLAB; which columns, under which names."""
