# The program in an image: docker build -t kds . && docker run --rm -v "$PWD:/work" kds info FILE
FROM debian:13-slim
WORKDIR /kds
COPY scripts/setup scripts/packages scripts/
RUN scripts/setup && rm -rf /var/lib/apt/lists/*
COPY . .
RUN cmake --preset program && cmake --build --preset program
WORKDIR /work
ENTRYPOINT ["/kds/build/release/bin/kds"]
