"""The service over HTTP.

middleware  the size limit of bodies, and the request id, headers, log line and metrics of all answers
json_route  routes with a JSON body
problems    exceptions as problem documents
routes      the endpoints and the pages
"""
