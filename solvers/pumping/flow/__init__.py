"""What the flow models share: nozzle (the gas and its discharge), duct -> record -> space_flow."""
