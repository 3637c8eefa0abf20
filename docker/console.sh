#!/usr/bin/env bash
# trailcast-console in a container. Beside the port that the host publishes, others of the
# container's network reach it, so it asks who they are, over TLS: what is not given for that is made
# at the first start and kept in /data. On the host's network, with TRAILCAST_HTTP_HOST=127.0.0.1,
# it is as anywhere else.
set -euo pipefail
if [[ ${TRAILCAST_HTTP_HOST:-} != 127.0.0.1 && ${1:-} != users ]]; then
  umask 077
  export TRAILCAST_ALERTS=${TRAILCAST_ALERTS:-/data/alerts.json}
  if [[ -z ${TRAILCAST_TLS_KEY:-} ]]; then
    export TRAILCAST_TLS_CERTIFICATE=/data/tls.pem TRAILCAST_TLS_KEY=/data/tls.key
    [[ -e $TRAILCAST_TLS_CERTIFICATE ]] || openssl req -x509 \
      -config <(printf '[req]\ndistinguished_name = name\n[name]\n') -subj /CN=localhost \
      -addext subjectAltName=DNS:localhost,IP:127.0.0.1 -days 365 \
      -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes \
      -keyout "$TRAILCAST_TLS_KEY" -out "$TRAILCAST_TLS_CERTIFICATE"
  fi
  if [[ -z ${TRAILCAST_USERS:-} ]]; then
    export TRAILCAST_USERS=/data/users
    if [[ ! -e $TRAILCAST_USERS ]]; then
      password=$(openssl rand -base64 15)
      trailcast-console users add operator --role operate <<<"$password"
      printf 'console.sh: log in as operator with the password %s\n' "$password" >&2
    fi
  fi
fi
exec trailcast-console "$@"
