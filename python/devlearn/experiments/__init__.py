"""What runs many jobs, and what is told of them."""
