function found = dualdamp_call(call, options, place)
% Runs the program and reads what it wrote.
  out = options.out;
  if isempty(out), out = fullfile(place, 'out'); end
  if ~exist(place, 'dir'), mkdir(place); end
  program = options.program;
  if isempty(program), program = getenv('DUALDAMP'); end
  if isempty(program), program = 'dualdamp'; end
  messages = fullfile(place, 'messages.txt');
  words = cellfun(@quoted, [{program}, call, {'--out', out}], 'UniformOutput', false);
  [status, ~] = system([strjoin(words, ' '), ' 2>', quoted(messages)]);
  text = strtrim(fileread(messages));
  if ~ismember(status, [0, 1, 4, 5])
    if status == 3, identifier = 'dualdamp:invalidScenario'; else, identifier = 'dualdamp:program'; end
    error(identifier, '%s', text);
  end
  found.document = jsondecode(fileread(fullfile(out, 'result.json')));
  found.status = status;
  found.messages = text;
  found.result = found.document.result;
  if isempty(found.result)
    error('dualdamp:numericalFailure', '%s', text);
  end
  found.tables = struct();
  files = dir(fullfile(out, '*.csv'));
  for i = 1:numel(files)
    [~, name] = fileparts(files(i).name);
    found.tables.(name) = dualdamp_table(fullfile(out, files(i).name));
  end
end

function word = quoted(word)
% For the shell.
  if ispc
    word = ['"', word, '"'];
  else
    word = ['''', strrep(word, '''', '''\'''''), ''''];
  end
end
