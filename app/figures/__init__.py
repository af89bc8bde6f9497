"""Figures: a declaration turns a request and its answer into data, one place draws the data.

Order: data, wording -> declaration -> models, and sweep and influence of studies -> registry; drawing and tables make
bytes of any of them, asked by rendering; comparison lays two cases into one figure.
"""
