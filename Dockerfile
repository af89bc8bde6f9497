# Two stages: the first installs and compiles the kernels, the second serves without tools, as nobody, on a read-only root.
FROM python:3.11-slim AS build
WORKDIR /src
COPY pyproject.toml constraints.txt README.md CHANGELOG.md ./
COPY app app
COPY solvers solvers
RUN python -m venv /opt/tribodrive && /opt/tribodrive/bin/pip install --no-cache-dir -c constraints.txt .
WORKDIR /
# Beside the installed sources, where the service finds the kernels and need not write.
RUN /opt/tribodrive/bin/python -m app.workers.stages

FROM python:3.11-slim
COPY --from=build /opt/tribodrive /opt/tribodrive
USER nobody
ENV PATH=/opt/tribodrive/bin:$PATH PYTHONDONTWRITEBYTECODE=1 TRIBODRIVE_HOST=0.0.0.0
WORKDIR /opt/tribodrive
EXPOSE 8000
HEALTHCHECK --start-period=60s CMD ["python", "-c", "import os, httpx; httpx.get(f'http://127.0.0.1:{os.environ.get(\"TRIBODRIVE_PORT\", 8000)}/readyz').raise_for_status()"]
CMD ["python", "-m", "app"]
