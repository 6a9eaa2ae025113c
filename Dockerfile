# oriel in a container, which reads and writes the current folder as its user:
#   docker build -t oriel --build-arg COMMIT="$(git rev-parse --short=12 HEAD)" .
#   docker run --rm --user "$(id -u):$(id -g)" -v "$PWD:/data" oriel label house.city.json -o labelled.city.json
# The first stage makes the packages, the second installs the command from them, with what it needs and nothing else.
FROM debian:12-slim AS build
WORKDIR /oriel
COPY examples/install_packages.sh examples/show_progress.sh examples/
RUN apt-get update && examples/install_packages.sh --build dpkg-dev file gzip help2man lintian
COPY CMakeLists.txt CMakePresets.json LICENSE README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md ./
COPY kernel kernel
COPY interpret interpret
COPY generalise generalise
COPY oriel oriel
COPY cli cli
COPY rules rules
COPY docs docs
COPY examples examples
COPY packaging packaging
# What `oriel --version` says; the tree here has no git.
ARG COMMIT=unknown
RUN examples/make_deb.sh -DORIEL_COMMIT="$COMMIT"

FROM debian:12-slim
COPY --from=build /oriel/build/package/packages/oriel_*.deb /tmp/
RUN apt-get update \
  && apt-get install -y --no-install-recommends /tmp/oriel_*.deb \
  && rm -rf /tmp/oriel_*.deb /var/lib/apt/lists/*
USER nobody
WORKDIR /data
ENTRYPOINT ["oriel"]
CMD ["--help"]
