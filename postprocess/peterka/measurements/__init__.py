"""Measured data: points from a CSV file (points), their marks over pictures (marks), and their residuals against a map (map_residuals)."""
