"""Line contacts: formulas, and the numerical solution of a lubricated contact (package `ehl`).

The formulas give the dry contact (`hertz`), the film thickness (`film`) and the flash temperature (`flash`).
"""
