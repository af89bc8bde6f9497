"""What the service counts, in the Prometheus text format at /metrics."""

from prometheus_client import Counter, Gauge, Histogram

REQUESTS = Counter("tribodrive_requests", "Requests answered", ["endpoint", "status"])
DURATION = Histogram("tribodrive_request_duration_seconds", "From first byte to last", ["endpoint"])
CALCULATIONS = Gauge("tribodrive_calculations", "Calculations running or waiting")
WAITING = Gauge("tribodrive_calculations_waiting", "Calculations waiting for a worker")
REFUSED = Counter("tribodrive_calculations_refused", "Calculations refused because the queue was full")
ENDED = Counter("tribodrive_calculations_interrupted", "Calculations ended for other clients and asked again later")
STUDIES = Gauge("tribodrive_studies", "Studies running")
WORKERS_LOST = Counter("tribodrive_workers_lost", "Worker processes that died while they computed")
DEADLINES_MISSED = Counter("tribodrive_deadlines_missed", "Calculations ended at their deadline")
LINES_DROPPED = Counter("tribodrive_log_lines_dropped", "Log lines lost because nobody read the log fast enough")
