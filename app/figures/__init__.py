"""Figures: a declaration turns a request and its answer into data, one place draws the data.

Order: data, wording, units -> declaration, parts, sketches -> models of the endpoints, studies, spectrum; drawing and
tables make bytes of any of them for rendering; comparison puts two cases into one figure.
"""
