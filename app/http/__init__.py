"""The service as HTTP: what stands between the network and the routes, and the routes.

server      uvicorn as `python -m app` runs it
connection  limits where bytes arrive: headers, connections, time
middleware  limits on bodies; what every answer carries and leaves behind: request id, headers, a log line, metrics
json_route  bodies of JSON
problems    errors as problem documents
routes      the endpoints and the pages
"""
