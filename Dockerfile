# The program in a container of Debian 12:
#   docker build -t remodel .
#   docker run --rm -v "$PWD:/work" -u "$(id -u):$(id -g)" remodel mesh naca:0012 -o mesh.su2
# The first stage builds the Debian package, the second one has nothing but what that needs.
FROM debian:12 AS build
COPY dependencies.txt /source/
COPY scripts/install-dependencies /source/scripts/
RUN /source/scripts/install-dependencies program && apt-get install -y --no-install-recommends dpkg-dev file
COPY . /source
WORKDIR /source
RUN cmake --preset demo && cmake --build --preset demo \
    && cd build/demo && cpack -G DEB -D CPACK_COMPONENTS_ALL=program

FROM debian:12
COPY --from=build /source/build/demo/remodel_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/remodel_*.deb libopenblas0-serial \
    && rm -rf /tmp/remodel_*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["remodel"]
CMD ["--help"]
