"""Parts that the flow models share: the gas and its flow through openings, the duct, records and results."""
