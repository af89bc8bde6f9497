"""The service over HTTP.

server      uvicorn as `python -m app` runs it, with limits on headers, connections and time
middleware  limits on bodies; request id, headers, log line and metrics of every answer
json_route  routes with a JSON body
problems    exceptions as problem documents
routes      the endpoints and the pages
"""
