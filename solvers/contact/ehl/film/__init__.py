"""The film of one contact: shear across it and fluxes along it -> column -> reynolds."""
