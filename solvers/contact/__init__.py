"""Line contacts: dry (Hertz), lubricated by formula, and lubricated by solution (ehl)."""
