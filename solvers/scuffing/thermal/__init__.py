"""How hot the contact runs: practice, blok -> temperatures -> thermal_path -> verdict."""
