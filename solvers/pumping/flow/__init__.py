"""Parts that the flow models share: nozzle (the gas and its discharge), duct, space_flow (records and results)."""
