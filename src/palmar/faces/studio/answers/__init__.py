"""What the page asks, answered part by part in a worker process."""
