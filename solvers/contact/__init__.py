"""Line contacts: dry (Hertz), lubricated by film formulas, and lubricated with a numerical solution (ehl)."""
