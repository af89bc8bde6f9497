# The first stage installs and compiles the kernels, the second serves without tools, as nobody, on a read-only root.
FROM python:3.11-slim AS base
# Kernels for any processor, not only the one that builds: they take up to a tenth longer.
ENV NUMBA_CPU_NAME=generic

FROM base AS build
COPY . /src
RUN /src/deploy/install /opt/tribodrive

FROM base
COPY --from=build /opt/tribodrive /opt/tribodrive
# numba looks for kernels only where it may write: a volume, which begins with what the image has there.
COPY --from=build --chown=nobody /opt/tribodrive/kernels /opt/tribodrive/kernels
VOLUME /opt/tribodrive/kernels
USER nobody
ENV PATH=/opt/tribodrive/bin:$PATH NUMBA_CACHE_DIR=/opt/tribodrive/kernels
ENV PYTHONDONTWRITEBYTECODE=1 TRIBODRIVE_HOST=0.0.0.0
WORKDIR /opt/tribodrive
EXPOSE 8000
HEALTHCHECK --start-period=60s CMD ["python", "-c", "import os, httpx; httpx.get(f'http://127.0.0.1:{os.environ.get(\"TRIBODRIVE_PORT\", 8000)}/readyz').raise_for_status()"]
CMD ["python", "-m", "app"]
