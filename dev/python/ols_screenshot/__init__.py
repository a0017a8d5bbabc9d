"""A picture of the console's page while the demo runs."""
