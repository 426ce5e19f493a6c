"""What somebody measured: points from a CSV file (points), how they look over pictures (marks), and how far a map is from
them (map_residuals)."""
