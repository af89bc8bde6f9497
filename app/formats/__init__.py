"""How an answer leaves the service."""
